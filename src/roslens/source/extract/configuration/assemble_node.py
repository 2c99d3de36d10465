"""One node of a configuration: its name, endpoints and parameters, from what starts it and what its code says."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec

from roslens.model.configuration import (
    ConfiguredEndpoint,
    ConfiguredNode,
    ConfiguredRemap,
    ConfiguredTimer,
    Missing,
    Origin,
    Proof,
    Unresolved,
)
from roslens.model.graph import Endpoint
from roslens.source.extract.catalogue.catalogue_items import each_item
from roslens.source.extract.catalogue.catalogue_plugins import plugged_by_parameters
from roslens.source.extract.catalogue.hints import hint_of, hinted
from roslens.source.extract.catalogue.implicit_endpoints import implicit_endpoints
from roslens.source.extract.catalogue.topic_tools import made_by_tool
from roslens.source.extract.configuration.assemble_actions import folded
from roslens.source.extract.configuration.assemble_arguments import CommandLine, command_line, kind_of_value
from roslens.source.extract.configuration.assemble_names import as_hinted, why_unknown
from roslens.source.extract.configuration.assemble_overrides import Overriding
from roslens.source.extract.facts.environment_defaults import supposed, supposed_place, supposed_rule
from roslens.source.extract.facts.launched import Launched, Setting
from roslens.source.extract.facts.meant import Meant
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, NodeFacts, Sure
from roslens.source.extract.facts.resolve_name import (
    TOP,
    Place,
    Rule,
    absolute,
    may_match,
    renamed,
    resolve,
    rule,
)
from roslens.source.extract.launch.ros1_nodelet import is_process
from roslens.source.extract.parameters.assemble_choices import (
    Alternative,
    Filled,
    IsGiven,
    alternatives,
    as_decided,
    chosen_of,
    doubt,
)
from roslens.source.extract.parameters.assemble_parameters import Values, declared_as_set, parameters_of
from roslens.source.extract.parameters.assemble_proof import launch_proof, proof_of
from roslens.source.extract.symbolic.condition import as_written, clauses_of, under_either
from roslens.source.extract.symbolic.reason import NamePart, OfNode, RandomEnd
from roslens.source.extract.symbolic.text import Conditions, IsSet, Text, unknown
from roslens.source.settings import NodeHint

_ITSELF = Alternative(Text())
_SIM_TIME = {"ros2": "use_sim_time", "ros1": "/use_sim_time"}


class Given(msgspec.Struct, frozen=True):
    """What starts a node, besides its code.

    Attributes:
        launched: as the launch file says.
        line: its command line.
        outside: parameters set outside of nodes (ROS 1).
        container: resolved name of the node it is loaded into.
        by_launch: whether a launch file starts it; else its target does.
        hints: of the user, by name of a node or ``package/executable``.
        hinted_in: the file that has the hints.
        parts: endpoints of code that is loaded into it though its own code was not seen to do so.
    """

    launched: Launched
    line: CommandLine
    generation: str
    outside: tuple[Setting, ...] = ()
    container: str = ""
    by_launch: bool = True
    hints: dict[str, NodeHint] = {}
    hinted_in: str = ""
    parts: tuple[EndpointFact, ...] = ()


def place_of(given: Given, facts: NodeFacts) -> Place:
    """Return the name and namespace of a node: what the launch file says holds over what its code says.

    roslaunch gives the name after the arguments, and the last one counts in ROS 1; launch_ros gives it after them too,
    and the first one counts in ROS 2 (rcl, remap.c).
    """
    launched, generation = given.launched, given.generation
    own = _usual(facts.name)
    rules = (*_own_rules(facts), *given.line.rules)
    name_rule = renamed("__node", own.known or "", rules, generation)
    namespace_rule = renamed("__ns", own.known or "", rules, generation)
    name = name_rule.target if name_rule is not None else own
    if launched.name.parts and (name_rule is None or generation == "ros1"):
        name = launched.name
    namespace = launched.namespace
    if generation == "ros2" and launched.namespace.parts in ((), ("/",)):
        namespace = absolute(TOP, _usual(facts.namespace))
    if namespace_rule is not None:
        namespace = absolute(TOP, namespace_rule.target)
    if not name.parts:
        name = unknown(OfNode(NamePart.NAME))
    # A name with a separator in it is one of ROS 1, where a node may be given a path.
    whole = absolute(namespace, name)
    return supposed_place(Place(namespace, whole, generation))


def _usual(text: Text) -> Text:
    return text.with_holes(lambda hole: hole if hole.default is None else hole.default)


def own_line(facts: NodeFacts) -> CommandLine:
    """Return the command line that code gives a node."""
    if not facts.arguments:
        return CommandLine()
    return command_line(facts.arguments, facts.generation, Evidence(facts.path, facts.line))


def _own_rules(facts: NodeFacts) -> tuple[Rule, ...]:
    return own_line(facts).rules


def values_of(given: Given, facts: NodeFacts) -> Values:
    """Return the parameters that are set for a node: what code gives it holds over what launch files say."""
    place = Evidence(facts.path, facts.line)
    own = [Setting(name, value, place, kind_of_value(value)) for name, value in facts.settings]
    # Parameters of a launch file come after the arguments; those that ROS 1 is given as arguments the node sets itself.
    both = (given.launched.settings, given.line.settings)
    first, second = both if given.generation == "ros1" else reversed(both)
    settings = (*given.outside, *first, *second, *own_line(facts).settings, *own)  # fmt: skip
    return Values(place_of(given, facts), settings, rules_of(given, facts))


def rules_of(given: Given, facts: NodeFacts) -> tuple[Rule, ...]:
    """Return the remappings of a node in the order in which they are tried."""
    launched = tuple(rule(one.source, one.target, one.evidence) for one in given.launched.remaps)
    if given.generation == "ros1":
        launched = tuple(Rule(one.source, one.target, one.evidence) for one in given.launched.remaps)
        return (*given.line.rules, *launched)
    return (*_own_rules(facts), *given.line.rules, *launched)


def assembled(given: Given, facts: NodeFacts, meant: Meant) -> tuple[ConfiguredNode, list[Unresolved]]:
    """Return a node and what of it is unresolved."""
    node = _Node(given, facts, meant)
    return node.configured(), node.unresolved


class _Node:
    def __init__(self, given: Given, facts: NodeFacts, meant: Meant) -> None:
        self.given, self.facts, self.meant = given, facts, meant
        self.place = place_of(given, facts)
        self.name = self.place.node.pattern
        self.written_rules = rules_of(given, facts)
        with_defaults = [supposed_rule(one) for one in self.written_rules]
        self.rules = tuple(one for one, _, _ in with_defaults)
        self.supposed_targets = {one: words for one, _, words in with_defaults if words}
        # Where the source of a remapping is supposed, it may be any name that is remapped.
        self.supposed = (*self.place.supposed, *(word for _, words, _ in with_defaults for word in words))
        self.values = values_of(given, facts)
        self.used = {number for number, one in enumerate(given.launched.remaps) if one in given.launched.taken}
        self.uncertain: set[int] = set()
        self.unresolved: list[Unresolved] = []
        self.formulas: dict[tuple[str, ...], Conditions] = {(): ()}
        self.overriding = Overriding(self.values, shared=facts.path.endswith(".py"))
        self.origin = meant.origin
        launched = given.launched
        what = (launched.plugin if launched.plugin.parts else launched.executable).pattern
        found = hint_of(given.hints, self.name, launched.package.pattern, what)
        self.hint: NodeHint | None
        self.hint_key, self.hint = found or ("", None)

    def configured(self) -> ConfiguredNode:
        facts, launched = self.facts, self.given.launched
        named = self.hint.names if self.hint else {}
        endpoints = [
            self._endpoint(chosen_of(one, chosen, name), chosen=chosen, looped=len(names) > 1)
            for one in (as_hinted(fact, named) for fact in self._there((*facts.endpoints, *self._plugged())))
            for chosen in alternatives(one.name, self.values)
            for names in (self.values.each(chosen.text),)
            for name in names
        ]
        endpoints += [self._endpoint(one, Origin.CODE) for one in self.given.parts]
        if self.hint:
            reported = hinted(self.hint, self.given.generation, self.given.hinted_in, self.hint_key)
            endpoints += [self._endpoint(one, Origin.HINT) for one in reported]
        if self.given.generation == "ros1":
            endpoints = folded(endpoints)
        parameters = parameters_of((*facts.parameters, *self.overriding.declared), self.values)
        if self.supposed:
            parameters = tuple(msgspec.structs.replace(one, uncertain=True) for one in parameters)
        if facts.declares_set:
            parameters = declared_as_set(parameters, proof_of(Evidence(facts.path, facts.line), self.origin))
        endpoints += self._implicit()
        self._unresolved_of_code()
        conditions = (*launched.conditions, *self.meant.conditions, *facts.conditions)
        return ConfiguredNode(
            self.name,
            self._started(),
            not self.place.node.holes,
            launched.package.pattern,
            (launched.plugin if launched.plugin.parts else launched.executable).pattern,
            self._kind(),
            proof_of(Evidence(facts.path, facts.line), self.origin),
            facts.unit,
            self.given.container,
            launched.machine,
            launched.anonymous or any(isinstance(hole.reason, RandomEnd) for hole in self.place.node.holes),
            as_written(conditions),
            tuple(self._distinct(endpoints)),
            parameters,
            tuple(self._remaps()),
            tuple(
                ConfiguredTimer(one.period_s, proof_of(one.evidence, self.origin), one.callback, one.group)
                for one in facts.timers
            ),
            clauses=clauses_of(conditions),
        )

    def _plugged(self) -> Iterator[EndpointFact]:
        launched = self.given.launched
        if self.origin is Origin.CATALOGUE:
            package, words = launched.package.pattern, self.given.line.rest
            yield from plugged_by_parameters(package, launched.executable.pattern, self.values)
            what = (launched.plugin if launched.plugin.parts else launched.executable).pattern
            yield from made_by_tool(package, what, self.given.generation, words, self.values)

    def _started(self) -> Proof:
        """Return what starts the node; its name is not certain where its options are unknown."""
        evidence, reason = self.given.launched.evidence, "; ".join(self._doubts(self.place.supposed))
        proof = launch_proof(evidence) if self.given.by_launch else proof_of(evidence)
        return msgspec.structs.replace(proof, sure=Sure.LIKELY.value, how=reason) if reason else proof

    def _doubts(self, supposed_: tuple[str, ...]) -> tuple[str, ...]:
        """Return why names may be others: what is unknown of its code's options, and what is supposed."""
        return (self.facts.doubt, *supposed_) if self.facts.doubt else supposed_

    def _there(self, facts: Iterable[EndpointFact]) -> Iterator[EndpointFact]:
        """Yield what is there as far as parameters of a node without source say so: ``imu0 is set``."""
        private = "~" if self.given.generation == "ros1" else ""
        outside = self.origin is Origin.CATALOGUE
        each = (one for fact in facts for one in (each_item(fact, self.values) if outside else (fact,)))
        decided = (as_decided(one, self.values, by_default=outside) for one in each)
        for fact in (one for one in decided if one is not None):
            asks = [one for one in fact.conditions if type(one) is IsSet] if outside else []
            if not asks:
                yield fact
            elif all(self.values.value(Text.of(private, one.text)) is not None for one in asks):
                others = tuple(one for one in fact.conditions if one not in asks)
                yield msgspec.structs.replace(fact, conditions=others)

    def _kind(self) -> str:
        kind = self.given.launched.kind
        if kind == "node" and self.facts.kind in ("lifecycle", "container"):
            return self.facts.kind
        return self.meant.kind or kind

    def _endpoint(
        self,
        fact: EndpointFact,
        origin: Origin | None = None,
        chosen: Alternative = _ITSELF,
        *,
        looped: bool = False,
    ) -> ConfiguredEndpoint:
        filled, of_name = self._named(fact.name)
        resolved, by = resolve(filled.text, self.place, self.rules)
        self._note(filled.text, by)
        kind = self.values.fill(fact.type)
        # Doubt about a name is that of its holes; with what launch files set they may be none.
        stated = Sure.CERTAIN if fact.name.holes else fact.evidence.sure
        sure = doubt(stated, chosen.sure, filled.sure, kind.sure if fact.type.holes else Sure.CERTAIN)
        if resolved.holes or (by is None and any(may_match(one, filled.text, self.place) for one in self.rules)):
            sure = Sure.POSSIBLE
        proof = proof_of(fact.evidence, origin or self.origin)
        doubted = (*of_name, *self._doubts(self.supposed), *(self.supposed_targets.get(by, ()) if by else ()))
        sure = doubt(sure, Sure.LIKELY) if doubted else sure
        why = (*chosen.how, *filled.how, *doubted)
        how = "; ".join(dict.fromkeys(map(str, why))) or ("" if fact.name.holes else proof.how)
        proof = msgspec.structs.replace(proof, sure=sure.value, how=how)
        given = str(fact.name)
        if resolved.holes:
            self._miss_name(given, fact, resolved)
        if kind.text.known is None:
            self._miss(str(fact.type), fact, f"the type of {resolved.pattern} is unknown")
        fact = self.overriding.take(fact, resolved, sure, looped=looped)
        return ConfiguredEndpoint(
            Endpoint(self.name, fact.role, resolved.pattern, kind.text.known or "", qos=fact.qos),
            proof, given, not resolved.holes, self._words(fact.conditions),
            None if by is None else launch_proof(by.evidence),
            fact.qos_unknown, fact.queue, fact.latched, fact.callback, fact.group,
            tuple(proof_of(one, self.origin) for one in fact.sites),
            tuple(proof_of(one, self.origin) for one in fact.through),
            any(isinstance(one, IsGiven) for one in why),
            clauses_of(fact.conditions),
        )  # fmt: skip

    def _named(self, name: Text) -> tuple[Filled, tuple[str, ...]]:
        filled = self.values.fill(name)
        if not filled.text.parts and name.holes:
            # No name at all is none of ROS: code that takes it has a condition, or would fail.
            filled = msgspec.structs.replace(filled, text=name, how=(*filled.how, "which is empty"))
        text, doubts = supposed(filled.text)
        sure = doubts and not text.holes
        return msgspec.structs.replace(filled, text=text, sure=Sure.LIKELY) if sure else filled, doubts

    def _note(self, name: Text, by: Rule | None) -> None:
        for number, one in enumerate(self.rules):
            if one is by:
                self.used.add(number)
            elif by is None and not one.special and may_match(one, name, self.place):
                self.uncertain.add(number)

    def _implicit(self) -> list[ConfiguredEndpoint]:
        facts = self.facts
        python = facts.path.endswith(".py") if self.origin is Origin.CODE else None
        found = implicit_endpoints(
            self.name, self.given.generation, self._kind(),
            sim_time=self.values.is_true(_SIM_TIME[self.given.generation]),
            lifecycle=facts.kind == "lifecycle" or self.given.launched.kind == "lifecycle",
            cpp=None if python is None else not python,
            process=is_process(self.given.launched),
        )  # fmt: skip
        remapped = []
        for one in found:
            resolved, by = resolve(Text.of(one.endpoint.name), self.place, self.rules)
            self._note(Text.of(one.endpoint.name), by)
            remap = None if by is None else launch_proof(by.evidence)
            endpoint = msgspec.structs.replace(one.endpoint, name=resolved.pattern)
            words = (*self.supposed, *(self.supposed_targets.get(by, ()) if by else ()))
            proof = msgspec.structs.replace(one.proof, sure="likely", how="; ".join(words)) if words else one.proof
            remapped.append(msgspec.structs.replace(one, endpoint=endpoint, proof=proof, remapped=remap))
        return remapped

    def _words(self, conditions: Conditions) -> tuple[str, ...]:
        """Return conditions in words, and remember which they were."""
        words = as_written(conditions)
        self.formulas[words] = conditions
        return words

    def _distinct(self, endpoints: Sequence[ConfiguredEndpoint]) -> list[ConfiguredEndpoint]:
        """Return endpoints sorted, those of code before the same ones that every node has."""
        kept: dict[tuple[str, str, str, str, int, bool], ConfiguredEndpoint] = {}
        for one in sorted(endpoints, key=lambda one: (one.implicit, one.proof.place)):
            end = one.endpoint
            place = "" if one.implicit else one.proof.path
            key = (end.role.value, end.name, end.type, place, 0 if one.implicit else one.proof.line, one.implicit)
            same = (end.role.value, end.name, end.type)
            if one.implicit and any(other[:3] == same for other in kept):
                continue
            before = kept.setdefault(key, one)
            if before.conditions != one.conditions:
                either = under_either(self.formulas[before.conditions], self.formulas[one.conditions])
                kept[key] = msgspec.structs.replace(before, conditions=self._words(either), clauses=clauses_of(either))
        return sorted(kept.values(), key=lambda one: (one.endpoint.role.value, one.endpoint.name, one.proof.place))

    def _remaps(self) -> list[ConfiguredRemap]:
        # Code that is unknown, or not understood everywhere, may have the name that a remapping is for.
        facts = self.facts
        open_ = bool(facts.unresolved) or not facts.endpoints or self.origin is not Origin.CODE
        found = []
        for number, one in enumerate(self.rules):
            if one.special:
                continue
            written = self.written_rules[number]
            used = number in self.used or written in self.values.used
            source = f"{one.node}:{one.source}" if one.node else str(one.source)
            uncertain = not used and (open_ or number in self.uncertain or one != written)
            found.append(ConfiguredRemap(source, str(one.target), launch_proof(one.evidence), used, uncertain))
        return found

    def _unresolved_of_code(self) -> None:
        for evidence, reason in self.facts.unresolved:
            self.unresolved.append(Unresolved("", proof_of(evidence, self.origin), reason, self.name))
        if self.place.node.holes:
            proof = launch_proof(self.given.launched.evidence)
            cause = why_unknown(self.place.node)
            reason, missing = f"the node's name depends on {cause}", Missing.NODE_NAME
            self.unresolved.append(
                Unresolved(str(self.place.node), proof, reason, self.name, missing=missing, cause=cause)
            )

    def _miss_name(self, text: str, fact: EndpointFact, name: Text) -> None:
        cause, proof = why_unknown(name), proof_of(fact.evidence, self.origin)
        reason = f"the name of this {fact.role.value.replace('_', ' ')} depends on {cause}"
        missing = Missing.ENDPOINT_NAME
        self.unresolved.append(Unresolved(text, proof, reason, self.name, missing=missing, cause=cause))

    def _miss(self, text: str, fact: EndpointFact, reason: str) -> None:
        self.unresolved.append(Unresolved(text, proof_of(fact.evidence, self.origin), reason, self.name))
