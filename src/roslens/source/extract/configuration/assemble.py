"""What launch files start and what code becomes, joined: the configuration of a system as it would run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import msgspec

from roslens.model.configuration import (
    NAME_IS_GUESSED,
    Configuration,
    ConfiguredArgument,
    ConfiguredNode,
    Unresolved,
)
from roslens.model.errors import DocumentError
from roslens.source.extract.configuration.assemble_arguments import CommandLine, command_line
from roslens.source.extract.configuration.assemble_controllers import controllers_in
from roslens.source.extract.configuration.assemble_doubt import doubted
from roslens.source.extract.configuration.assemble_loads import loaded_by, with_used
from roslens.source.extract.configuration.assemble_names import container_name
from roslens.source.extract.configuration.assemble_node import Given, assembled, place_of, values_of
from roslens.source.extract.configuration.assemble_parts import parts_of
from roslens.source.extract.configuration.assemble_plugins import with_plugins
from roslens.source.extract.configuration.assemble_units import Units, as_script, meant_by
from roslens.source.extract.facts.environment_defaults import supposed_name, with_defaults
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Argument, Controller, Launch, Launched, Setting
from roslens.source.extract.facts.meant import Meant
from roslens.source.extract.facts.node_facts import EndpointFact, Inherits, NodeFacts, Target, TargetKind
from roslens.source.extract.facts.resolve_name import TOP, absolute
from roslens.source.extract.launch.process_commands import as_node
from roslens.source.extract.launch.ros1_nodelet import Bond, has_bond, with_bonds
from roslens.source.extract.overlays.language.command_words import words_of
from roslens.source.extract.parameters.assemble_parameters import Values, set_outside
from roslens.source.extract.parameters.assemble_proof import launch_proof
from roslens.source.extract.parameters.parameter_file import ros2_parameters
from roslens.source.extract.symbolic.text import Text, Written
from roslens.source.extract.symbols.call_sites import places_of
from roslens.source.settings import NodeHint

Known = Callable[[Launched, str, Sequence[Text]], Meant | None]
"""What is known of a node whose code is not in the workspace: by what is started, the generation and its arguments."""

_CLASSES = {TargetKind.COMPONENT: "component", TargetKind.NODELET: "nodelet"}
_STARTED = frozenset({TargetKind.EXECUTABLE, TargetKind.SCRIPT})


def assemble(
    launch: Launch,
    units: Units,
    *,
    title: str,
    known: Known | None = None,
    files: Files | None = None,
    by_launch: bool = True,
    hints: Mapping[str, NodeHint] | None = None,
    hinted_in: str = "roslens.toml",
) -> Configuration:
    """Return the configuration that a launch comes to.

    Args:
        launch: what is started and set.
        units: the code of the workspace.
        title: of the configuration.
        known: knows nodes whose code is not in the workspace.
        files: from which files of parameters on command lines are read.
        by_launch: False where ``launch`` stands for targets, see :func:`targets_started`.
        hints: of the user, by name of a node or ``package/executable``.
        hinted_in: the file that has the hints.

    Raises:
        UsageError: a hint tells no endpoint.
    """
    whole = _Whole(launch, units, known, files, by_launch=by_launch, hints=hints or {}, hinted_in=hinted_in)
    for launched in launch.nodes:
        whole.start(launched)
    whole.end()
    unresolved = [
        Unresolved(
            one.text,
            launch_proof(one.evidence),
            one.reason,
            opens=one.opens,
            missing=one.missing,
            standing=one.standing,
        )
        for one in launch.unresolved
    ]
    unresolved += whole.unresolved
    return Configuration(
        title,
        launch.generation,
        tuple(
            sorted(doubted(with_bonds(whole.nodes, whole.bonds), unresolved), key=lambda node: (node.name, node.proof))
        ),
        tuple(set_outside(launch.settings)),
        tuple(_argument(one) for one in launch.arguments),
        launch.included,
        tuple(sorted(dict.fromkeys(unresolved), key=lambda one: (one.proof, one.node, one.text, one.reason))),
    )


def targets_started(package: str, units: Units, generation: str) -> Launch:
    """Return a launch of all that a package's build makes: each program, each component and nodelet."""
    nodes = []
    for target in sorted(units.targets(package), key=lambda one: (one.name, one.evidence)):
        kind = _CLASSES.get(target.kind)
        if kind is not None:
            nodes.append(_started(target, kind))
        elif target.kind in _STARTED and (target.installed or _runs_uninstalled(target, generation)):
            nodes.append(_started(target, "node"))
    return Launch(generation, tuple(nodes))


def _runs_uninstalled(target: Target, generation: str) -> bool:
    """Whether rosrun finds a program that no rule installs: the folder of a catkin build has all that are compiled."""
    return generation == "ros1" and target.kind is TargetKind.EXECUTABLE


def _started(target: Target, kind: str) -> Launched:
    name = Text.of(target.name)
    return Launched(
        package=Text.of(target.package),
        executable=Text() if kind != "node" else name,
        evidence=target.evidence,
        plugin=name if kind != "node" else Text(),
        conditions=tuple(map(Written, target.conditions)),
        kind=kind,
    )


class _Whole:
    def __init__(
        self,
        launch: Launch,
        units: Units,
        known: Known | None,
        files: Files | None,
        *,
        by_launch: bool,
        hints: Mapping[str, NodeHint],
        hinted_in: str,
    ) -> None:
        self.hints, self.hinted_in = dict(hints), hinted_in
        self.launch, self.units, self.known, self.files, self.by_launch = launch, units, known, files, by_launch
        self.nodes: list[ConfiguredNode] = []
        self.bonds: list[Bond] = []
        self.unresolved: list[Unresolved] = []
        self.controllers = [one for node in launch.nodes for one in node.controllers]
        self.loaded: set[Controller] = set()

    def end(self) -> None:
        """Tell of what nobody was found to load."""
        for one in self.controllers:
            if one not in self.loaded:
                name = one.name.pattern.removeprefix(one.space.pattern).removeprefix("/")
                self.unresolved.append(Unresolved(f"controller {name}", launch_proof(one.evidence), one.why))

    def start(self, launched: Launched) -> None:
        """Add the nodes that something makes, and those that they load."""
        generation = self.launch.generation
        if launched.kind == "process":
            launched = as_node(launched) or launched
        if launched.kind == "process":
            words = " ".join(str(word) for word in (launched.executable, *launched.arguments) if word.parts)
            reason = "a program is started that is not a known node: its endpoints are unknown"
            self._miss(words or "a process", launched, reason, opens=True)
            return
        line = command_line(launched.arguments, generation, launched.evidence)
        meant = self._meant(launched, line)
        given = Given(
            launched,
            self._with_files(line, launched),
            generation,
            self.launch.settings,
            container_name(launched, generation),
            self.by_launch,
            self.hints,
            self.hinted_in,
        )
        if any(one.plugins or one.asks for one in meant.facts):
            meant = self._with_plugins(given, meant)
        first = meant.facts[0] if meant.facts else _nothing(launched, generation)
        if has_bond(launched):
            name = place_of(given, first).node.pattern
            self.bonds.append(Bond(name, given.container, launched.conditions))
        known = {place for one in meant.facts for place in places_of(one)}
        parts = parts_of(given, first, self.units, known, self.hints)
        given = msgspec.structs.replace(given, parts=(*parts, *self._of_controllers(given, first)))
        if meant.facts:
            self._add(given, meant)
        elif self.by_launch:
            # A program of a build that makes no node is no node; of one in a launch file, the file says that it is one.
            self._add_unknown(given, first, meant)

    def _add(self, given: Given, meant: Meant) -> None:
        """Add the nodes whose code is known, each with those that it loads."""
        for number, facts in enumerate(meant.facts):
            held = given
            if number and given.generation == "ros2":
                facts = values_of(given, meant.facts[0]).filled_by_maker(facts)
                held = self._further(given, facts)
            elif number:
                held = msgspec.structs.replace(given, parts=())
            node, missing = assembled(held, facts, meant)
            place = len(self.nodes)
            self.nodes.append(with_checksums(node, self.units))
            self.unresolved += missing
            if facts.loads and given.launched.kind != "nodelet":
                for loaded in loaded_by(held, facts):
                    self.start(loaded)
                self.nodes[place] = with_used(self.nodes[place], self.nodes[place + 1 :])

    def _add_unknown(self, given: Given, facts: NodeFacts, meant: Meant) -> None:
        """Add a node whose code is unknown: its launch file says what it has."""
        node, missing = assembled(given, facts, meant)
        self.nodes.append(msgspec.structs.replace(node, defined=None))
        self.unresolved += [one for one in missing if one.reason]
        reason = f"{meant.reason}; its endpoints are unknown"
        self._miss(_shown(given.launched), given.launched, reason, outside=meant.outside)

    def _of_controllers(self, given: Given, facts: NodeFacts) -> list[EndpointFact]:
        found: list[EndpointFact] = []
        for controller, made in controllers_in(given, facts, self.controllers, self.units):
            found += made
            self.loaded.add(controller)
        return found

    def _further(self, given: Given, facts: NodeFacts) -> Given:
        """Return what holds for a further node of a process or component.

        What a component is loaded with is for that node alone (rclcpp_components, component_manager.cpp), unless code
        passes its options on. The command line of a process is for all nodes of it that do not refuse it, the name that
        it gives included (rcl, ``rcl_remap_node_name``).
        """
        loaded, line = given.launched, given.line
        process = loaded
        if loaded.kind == "component":
            found = [one for one in self.launch.nodes if _is_container(one)]
            box = next((one for one in found if _whole_name(one) == given.container), None)
            process = _without_line(loaded) if box is None else box
            line = CommandLine() if box is None else command_line(box.arguments, "ros2", box.evidence)
        if not facts.global_arguments:
            process, line = _without_line(loaded), CommandLine()
        name, namespace, remaps, settings = process.name, process.namespace, process.remaps, process.settings
        if loaded.kind == "component" and facts.inherits in (Inherits.ALL, Inherits.ARGUMENTS):
            name = loaded.name if loaded.name.parts else name
            namespace = namespace if loaded.namespace.parts in ((), TOP.parts) else loaded.namespace
            remaps = (*loaded.remaps, *remaps)
        if loaded.kind == "component" and facts.inherits in (Inherits.ALL, Inherits.PARAMETERS):
            settings = (*settings, *loaded.settings)
        launched = msgspec.structs.replace(loaded, name=name, namespace=namespace, remaps=remaps, settings=settings)
        return msgspec.structs.replace(given, launched=launched, line=line, parts=())

    def _meant(self, launched: Launched, line: CommandLine) -> Meant:
        words = words_of(launched, self.launch.generation) if self.by_launch else None
        meant = meant_by(launched, self.units, words)
        if not meant.facts and self.launch.generation == "ros1":
            meant = as_script(launched, self.units, words) or meant
        if not meant.facts and self.known is not None:
            meant = self.known(launched, self.launch.generation, line.rest) or meant
        if launched.plugged and meant.facts:
            first, *rest = meant.facts
            first = msgspec.structs.replace(first, endpoints=(*first.endpoints, *launched.plugged))
            meant = msgspec.structs.replace(meant, facts=(first, *rest))
        return meant

    def _with_plugins(self, given: Given, meant: Meant) -> Meant:
        """Return what is started with what the plug-ins make that its parameters name."""
        launched, words = given.launched, words_of(given.launched, self.launch.generation) if self.by_launch else None
        main = meant.facts[0]

        def values(facts: NodeFacts, number: int) -> Values:
            if not number or self.launch.generation != "ros2":
                return values_of(given, facts)
            filled = values_of(given, main).filled_by_maker(facts)
            return values_of(self._further(given, filled), filled)

        return with_plugins(meant, lambda chosen: meant_by(launched, self.units, words, chosen), values)

    def _with_files(self, line: CommandLine, launched: Launched) -> CommandLine:
        if not line.files:
            return line
        settings: list[Setting] = []
        for file in line.files:
            content = None if file.known is None or self.files is None else self.files.content(joined("", file.known))
            if content is None:
                self._miss(str(file), launched, "there is no such parameter file in the workspace")
                continue
            try:
                settings += ros2_parameters(content, joined("", file.known or ""))
            except DocumentError as error:
                self._miss(error.what, launched, f"{error.where}: expected {error.expected}")
        return msgspec.structs.replace(line, settings=(*settings, *line.settings))

    def _miss(
        self, text: str, launched: Launched, reason: str, *, opens: bool = False, outside: tuple[str, ...] = ()
    ) -> None:
        proof = launch_proof(launched.evidence)
        self.unresolved.append(Unresolved(text, proof, reason, opens=opens, outside=outside))


def _nothing(launched: Launched, generation: str) -> NodeFacts:
    """Return facts of a node of which nothing is known; in ROS 2 its code names it where its launch file does not."""
    guessed = generation == "ros2" and launched.kind == "node" and not launched.name.parts
    doubt = NAME_IS_GUESSED if guessed else ""
    evidence = launched.evidence
    return NodeFacts("", evidence.path, evidence.line, generation, name=launched.executable, doubt=doubt)


def _is_container(launched: Launched) -> bool:
    """Whether a node loads components: by an action of its own, or as the plain program of rclcpp_components."""
    if launched.kind == "container":
        return True
    executable = launched.executable.known or ""
    return launched.package.known == "rclcpp_components" and executable.startswith("component_container")


def _whole_name(launched: Launched) -> str:
    return supposed_name(absolute(launched.namespace, launched.name)).pattern


_KINDS = {"publisher": "msg", "subscription": "msg", "service": "srv", "action": "action"}


def with_checksums(node: ConfiguredNode, units: Units) -> ConfiguredNode:
    """Return a node whose endpoints tell which definition of their type they use."""
    endpoints = []
    for one in node.endpoints:
        end = one.endpoint
        package, _, name = end.type.partition("/")
        kind = _KINDS[end.role.value.partition("_")[0]]
        generation = "ros2" if name.startswith(f"{kind}/") else "ros1"
        whole = f"{package}/{kind}/{name.removeprefix(f'{kind}/')}"
        known = units.checksum(whole, generation, one.proof.path) if name else ""
        if known:
            one = msgspec.structs.replace(one, endpoint=msgspec.structs.replace(end, hash=known))
        endpoints.append(one)
    return msgspec.structs.replace(node, endpoints=tuple(endpoints))


def _without_line(launched: Launched) -> Launched:
    return msgspec.structs.replace(launched, name=Text(), namespace=TOP, remaps=(), settings=())


def _shown(launched: Launched) -> str:
    return "/".join(str(one) for one in (launched.package, launched.plugin or launched.executable) if one.parts)


def _argument(one: Argument) -> ConfiguredArgument:
    default = None if one.default is None else with_defaults(one.default)
    return ConfiguredArgument(one.name, launch_proof(one.evidence), default, one.description, one.choices)
