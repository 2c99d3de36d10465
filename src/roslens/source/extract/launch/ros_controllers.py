"""What controllers of ros_control make of topics and services: those that a launch file spawns into a simulation.

A controller runs within the node that has the manager of controllers. What each type makes is in
``catalogue/ros_control/controllers.yaml``; releases differ, so none of it is certain.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib import resources

import msgspec

from roslens.judge.documents.yaml_tree import read_tree
from roslens.model.errors import DocumentError
from roslens.source.extract.catalogue.catalogue import plain_value
from roslens.source.extract.catalogue.catalogue_plugins import Class
from roslens.source.extract.catalogue.hints import ROLES, endpoint_of
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Controller, Launch, Launched, Setting, Unresolved
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, Sure
from roslens.source.extract.facts.resolve_name import Place, absolute, expand
from roslens.source.extract.parameters.parameter_file import ros1_parameters
from roslens.source.extract.symbolic.text import Conditions, Text

_PACKAGE, _SPAWNER = "controller_manager", "spawner"
_LOADS = "controller_manager/load_controller"
_NAMESPACE = "--namespace"
_WITH_VALUE = frozenset({"--wait-for", _NAMESPACE, "--timeout", "--shutdown-timeout"})
_FILES = re.compile(r"\.ya?ml\Z")
_DEFAULT = re.compile(r"(\w+) \((true|false)\)")


class _Spawned(msgspec.Struct, frozen=True):
    """A controller that a spawner asks for.

    Attributes:
        name: of it.
        space: namespace of its manager.
        settings: parameters of the file that the spawner reads.
        why: nothing more is known of it.
    """

    name: str
    space: Text
    settings: tuple[Setting, ...] = ()
    why: str = ""


def with_controllers(launch: Launch, files: Files) -> Launch:
    """Return a launch in which nodes that are known to have a manager have what the controllers in it make.

    Args:
        launch: all that is started and set, with what plug-ins make.
        files: from which spawners read parameters.
    """
    started = _Started(launch)
    for number, spawner in enumerate(launch.nodes):
        if (spawner.package.known, spawner.executable.known) == (_PACKAGE, _SPAWNER):
            for spawned in _spawned(spawner, files):
                started.spawn(spawned, spawner, number)
    return started.launch()


class _Started:
    """A launch, to which controllers are added one after the other."""

    def __init__(self, launch: Launch) -> None:
        self._launch = launch
        self._nodes, self._settings = list(launch.nodes), list(launch.settings)
        self._unresolved = list(launch.unresolved)

    def spawn(self, spawned: _Spawned, spawner: Launched, number: int) -> None:
        """Give what a controller makes to the node of its manager, or keep it with its spawner, node ``number``."""
        self._settings += [one for one in spawned.settings if one not in self._settings]
        made, why = _made(spawned, spawner, {_resolved(one): one for one in self._settings})
        place = _manager(self._nodes, spawned.space)
        if made and place is None:
            why = "the node with the manager of this controller is unknown"
        later = _for_later(spawned, spawner, self._settings, made, why) if why else None
        if later is not None:
            held = self._nodes[number]
            self._nodes[number] = msgspec.structs.replace(held, controllers=(*held.controllers, later))
            return
        if made and place is not None:
            node = self._nodes[place]
            self._nodes[place] = msgspec.structs.replace(node, plugged=(*node.plugged, *made))
        if why:
            self._unresolved.append(Unresolved(f"controller {spawned.name}", spawner.evidence, why))

    def launch(self) -> Launch:
        """Return the launch with all of them."""
        nodes, settings = tuple(self._nodes), tuple(self._settings)
        unresolved = tuple(dict.fromkeys(self._unresolved))
        return msgspec.structs.replace(self._launch, nodes=nodes, settings=settings, unresolved=unresolved)


def _for_later(
    spawned: _Spawned, spawner: Launched, settings: Iterable[Setting], made: Iterable[EndpointFact], why: str
) -> Controller | None:
    """Return a controller whose type is known, for who knows code: of its class, and of what has the manager."""
    own = absolute(spawned.space, Text.of(spawned.name))
    kind = {_resolved(one): one for one in settings}.get(f"{own.pattern}/type")
    if spawned.why or kind is None or kind.value.known is None:
        return None
    return Controller(own, kind.value.known, spawned.space, spawner.evidence, tuple(made), why, spawner.conditions)


def _spawned(spawner: Launched, files: Files) -> Iterator[_Spawned]:
    """Yield what the words of a spawner ask for: names, or files whose keys are names (controller_manager, spawner)."""
    space, names, flag = spawner.namespace, [], ""
    for word in spawner.arguments:
        known = word.known or ""
        if (given := _namespace_in(word, flag)) is not None:
            space = absolute(spawner.namespace, given)
        if flag:
            flag = ""
        elif known.startswith("--") or ":=" in word.pattern:
            flag = known if known in _WITH_VALUE else ""
        else:
            names.append(word)
    for one in names:
        yield from _of_word(one, space, spawner, files)


def _namespace_in(word: Text, flag: str) -> Text | None:
    """Return the namespace that a word gives after its option or together with it; None where it gives none."""
    option, sign, value = (word.known or "").partition("=")
    if flag != _NAMESPACE and not (option == _NAMESPACE and sign):
        return None
    return Text.of(value) if sign else word


def _of_word(word: Text, space: Text, spawner: Launched, files: Files) -> Iterator[_Spawned]:
    name = word.known
    if name is None:
        yield _Spawned(str(word), space, why=f"its name depends on {word.holes[0].reason}")
    elif _FILES.search(name):
        yield from _of_file(name, space, spawner, files)
    else:
        yield _Spawned(name, space)


def _of_file(name: str, space: Text, spawner: Launched, files: Files) -> Iterator[_Spawned]:
    path = joined("", name)
    content = files.content(path)
    try:
        found = [] if content is None else ros1_parameters(content, path)
    except DocumentError as error:
        yield _Spawned(name, space, why=f"{error.what}; expected {error.expected}")
        return
    if content is None:
        yield _Spawned(name, space, why="there is no such parameter file in the workspace")
    held = [msgspec.structs.replace(one, name=absolute(spawner.namespace, one.name)) for one in found]
    for key in dict.fromkeys(one.name.pattern.partition("/")[0] for one in found):
        yield _Spawned(key, space, tuple(held))


def _resolved(setting: Setting) -> str:
    return setting.name.pattern if setting.name.pattern.startswith("/") else f"/{setting.name.pattern}"


def _made(spawned: _Spawned, spawner: Launched, settings: Mapping[str, Setting]) -> tuple[list[EndpointFact], str]:
    """Return what a controller makes, and the reason where that is unknown."""
    if spawned.why:
        return [], spawned.why
    own = absolute(spawned.space, Text.of(spawned.name))
    kind = settings.get(f"{own.pattern}/type")
    if kind is None or kind.value.known is None:
        return [], "no parameter file states its type; its endpoints are unknown"
    controller = controllers().get(kind.value.known)
    if controller is None:
        return [], f"{kind.value.known} is not a known controller; its endpoints are unknown"
    how = f"controller {kind.value.known} creates it; differs between releases"
    evidence = Evidence(kind.evidence.path, kind.evidence.line, kind.evidence.column, how, Sure.LIKELY)
    found = []
    for key, line in controller.lines():
        name, _, rest = line.partition(" ")
        fact = endpoint_of(f"x {rest}", ROLES[key], "ros1", evidence)
        if (conditions := _open(fact.conditions, own.pattern, settings)) is None:
            continue
        above, own_name = (spawned.space, name[3:]) if name.startswith("../") else (own, name)
        whole = absolute(above, Text.of(own_name))
        found.append(msgspec.structs.replace(fact, name=whole, conditions=(*spawner.conditions, *conditions)))
    return found, ""


def _open(conditions: Conditions, own: str, settings: Mapping[str, Setting]) -> Conditions | None:
    """Return the undecidable conditions; None if one does not hold."""
    left = []
    for one in conditions:
        match = _DEFAULT.fullmatch(str(one))
        setting = settings.get(f"{own}/{match[1]}") if match else None
        value = match[2] if match and setting is None else setting.value.known if setting is not None else None
        if value is None:
            left.append(one)
        elif value.lower() != "true":
            return None
    return tuple(left)


def _manager(nodes: Iterable[Launched], space: Text) -> int | None:
    """Return the place of the node that has the manager of a namespace, by its service."""
    wanted = absolute(space, Text.of(_LOADS))
    for number, node in enumerate(nodes):
        place = Place(node.namespace, absolute(node.namespace, node.name), "ros1")
        if any(expand(one.name, place) == wanted for one in node.plugged):
            return number
    return None


@cache
def controllers() -> Mapping[str, Class]:
    """Return the controllers of the catalogue by type."""

    class File(msgspec.Struct, forbid_unknown_fields=True):
        controllers: tuple[Class, ...]

    folder = resources.files("roslens.source.extract").joinpath("catalogue").joinpath("ros_control")
    tree = read_tree(folder.joinpath("controllers.yaml").read_bytes(), "controllers.yaml")
    found = msgspec.convert(plain_value(tree.root), File, strict=False).controllers
    return {kind: one for one in found for kind in one.types}
