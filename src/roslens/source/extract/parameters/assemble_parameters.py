"""Which value each parameter of a node has, and what sets it; texts in which such values stand in place of holes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby
from operator import attrgetter
from typing import Any

import msgspec

from roslens.model.configuration import ConfiguredParameter, Proof
from roslens.source.extract.facts.environment_defaults import supposed_name
from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import NodeFacts, ParameterFact, Sure, with_texts
from roslens.source.extract.facts.resolve_name import Place, Rule, base_name, expand, node_pattern_matches, resolve
from roslens.source.extract.parameters.assemble_choices import Filled, IsGiven, Why, decided_by, doubt
from roslens.source.extract.parameters.assemble_lists import each_of, items_among, parameter_of
from roslens.source.extract.parameters.assemble_proof import launch_proof, proof_of
from roslens.source.extract.parameters.assemble_written import Write, after_writes
from roslens.source.extract.parameters.ros2_values import LIST
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.reason import (
    FIRST,
    MAKER,
    NamePart,
    OfNode,
    OfParameter,
    Reason,
    for_node,
    node_of_reason,
)
from roslens.source.extract.symbolic.text import Choice, Hole, Text

_NAME_OF_NODE = OfNode(NamePart.NAME)
_FULL_NAME_OF_NODE = OfNode(NamePart.FULL_NAME)
_NAMESPACE_OF_NODE = OfNode(NamePart.NAMESPACE)
_NAMESPACE_ABOVE = OfNode(NamePart.ABOVE)
_MOST_ITEMS = 100
_ACCESS = {"declared": 0, "read": 1, "written": 2, "": 3}


class Values:
    """The parameters that are set for one node; the last setting of a name holds."""

    def __init__(self, place: Place, settings: Iterable[Setting], rules: tuple[Rule, ...] = ()) -> None:
        """Keep the settings that are for the node at ``place``, in order of growing precedence."""
        self._place = place
        self._rules = rules
        self.set: dict[str, Setting] = {}
        self.used: set[Rule] = set()
        node = place.node.pattern
        meant: dict[str, bool] = {"": True}
        # A file has many values of one node after the other: most files hold those of all nodes that run.
        for pattern, group in groupby(settings, attrgetter("node")):
            if pattern not in meant:
                meant[pattern] = node_pattern_matches(pattern, node)
            for one in group if meant[pattern] else ():
                name = self._setting_name(one)
                self.set.pop(name, None)
                self.set[name] = one

    @property
    def generation(self) -> str:
        """``ros1`` or ``ros2``."""
        return self._place.generation

    def key(self, name: Text) -> str:
        """Return a name in the form in which parameters are compared: as it is in ROS 2, resolved in ROS 1."""
        if self._place.generation == "ros2":
            return name.pattern
        resolved, rule = resolve(name, self._place, self._rules)
        if rule is not None:
            self.used.add(rule)
        return supposed_name(resolved).pattern

    def _setting_name(self, setting: Setting) -> str:
        if self._place.generation == "ros2":
            return setting.name.pattern
        return supposed_name(expand(setting.name, self._place)).pattern

    def value(self, name: Text) -> Setting | None:
        """Return what sets a parameter."""
        return self.set.get(self.key(name))

    def each(self, text: Text) -> tuple[Text, ...]:
        """Return a text for each element where a parameter in it is a list, with the element in its place."""
        return tuple(one for (one,) in each_of((text,), self.items_of))

    def items_of(self, hole: Hole) -> list[str | Hole] | None:
        """Return the elements of a list that a parameter is; None where it is none."""
        parameter = parameter_of(hole)
        if not parameter or hole.choice:
            return None
        found = self.value(Text.of(parameter))
        names = items_among(hole, None if found is None else found.value)
        if names is None:
            return None
        where = f"default of {hole.reason}" if found is None else f"{hole.reason}, set in {_place_of(found)}"
        # A hole that its value fills keeps the doubt of a default.
        return [Hole(where, default=one) if found is None else one for one in names[:_MOST_ITEMS]]

    def fill(self, text: Text) -> Filled:
        """Return a text with the values of parameters, else their defaults, in place of holes."""
        if not text.holes:
            return Filled(text)
        parts: list[Text] = []
        sure = Sure.CERTAIN
        how: list[Why] = []
        for part in text.parts:
            match part:
                case str():
                    parts.append(Text((part,)))
                    continue
            found, less, notes = self._of_hole(part)
            if found.is_global and len(parts) == 1 and _is_private_space(parts[0]):
                # A name that a private handle is given stays global: roscpp, NodeHandle::resolveName.
                parts.clear()
            parts.append(found)
            how += notes
            sure = doubt(sure, less)
        return Filled(Text.of(*parts), sure, tuple(dict.fromkeys(how)))

    def _of_hole(self, hole: Hole) -> tuple[Text, Sure, tuple[Why, ...]]:
        if hole.reason in (_NAME_OF_NODE, _FULL_NAME_OF_NODE):
            return self._of_name(hole.reason)
        if hole.reason in (_NAMESPACE_OF_NODE, _NAMESPACE_ABOVE):
            return self._namespace(hole.reason), Sure.CERTAIN, (str(hole.reason),)
        if hole.choice:
            return self._of_choice(hole, hole.choice[0])
        found = self.value(Text.of(hole.parameter)) if hole.parameter else None
        if found is not None:
            return self._of_setting(hole, found)
        if hole.default is not None:
            of = f"default of parameter {hole.parameter}" if hole.parameter else f"default of {hole.reason}"
            return self._placed(Text.of(hole.default), hole), Sure.LIKELY, (of,)
        return Text((hole,)), Sure.POSSIBLE, (str(hole.reason),) if hole.reason else ()

    def _of_name(self, reason: Reason) -> tuple[Text, Sure, tuple[Why, ...]]:
        whole = self._place.node
        short = reason == _NAME_OF_NODE and self._place.generation == "ros2" and whole.known is not None
        name = Text.of(base_name(whole.pattern)) if short else whole
        return name, Sure.POSSIBLE if name.holes else Sure.CERTAIN, (str(reason),)

    def _of_setting(self, hole: Hole, setting: Setting) -> tuple[Text, Sure, tuple[Why, ...]]:
        how = IsGiven(hole.parameter, _place_of(setting))
        if hole.reason != OfParameter(hole.parameter):
            # The value decides, but it is not what stands there.
            return Text((Hole(f"{hole.reason}: {how}"),)), Sure.POSSIBLE, (how,)
        sure = Sure.LIKELY if self._place.supposed else Sure.CERTAIN
        return self._placed(setting.value, hole), Sure.POSSIBLE if setting.value.known is None else sure, (how,)

    def _of_choice(self, hole: Hole, choice: Choice) -> tuple[Text, Sure, tuple[Why, ...]]:
        decided = decided_by(choice, self)
        if decided.holds is None:
            return Text((Hole(hole.reason),)), Sure.POSSIBLE, (str(hole.reason),)
        filled = self.fill(choice.then if decided.holds else choice.otherwise)
        return filled.text, doubt(decided.sure, filled.sure), tuple(dict.fromkeys((*decided.how, *filled.how)))

    def _namespace(self, reason: Reason) -> Text:
        space = self._place.namespace
        if reason == _NAMESPACE_OF_NODE:
            return space
        if "/" not in space.tail:
            return Text((Hole(f"namespace above {space}"),))
        return Text.of(*space.parts[:-1], space.tail.rpartition("/")[0])

    def _placed(self, value: Text, hole: Hole) -> Text:
        """Return a value below the namespace that it is relative to, where it is another one than the node's own."""
        if not hole.below or value.is_global or (value.parts and not value.head):
            return value
        return Text.of(self._namespace(hole.below), "/", value)

    def filled_by_maker(self, facts: NodeFacts) -> NodeFacts:
        """Return facts of a node that this node makes, with what this one knows in place of holes."""
        return with_texts(facts, self._made)

    def _made(self, text: Text) -> Text:
        return text.mapped(self._of_maker)

    def _of_maker(self, hole: Hole) -> Text | Hole:
        if node_of_reason(hole.reason) != MAKER:
            return hole
        found, sure, _ = self._of_hole(msgspec.structs.replace(hole, reason=for_node(hole.reason, FIRST)))
        if sure is Sure.CERTAIN and found.known is not None:
            return found
        return Hole(hole.reason, "", found.known)

    def is_true(self, name: str, default: str | None = None) -> bool:
        """Return whether a parameter is set to true."""
        found = self.value(Text.of(name))
        value = found.value.known if found is not None else default
        return (value or "").lower() in ("true", "1", "yes", "on")


def _is_private_space(text: Text) -> bool:
    known = text.known or ""
    return known.startswith("~") and known.endswith("/")


def parameters_of(facts: Iterable[ParameterFact], values: Values) -> tuple[ConfiguredParameter, ...]:
    """Return the parameters that code knows with what sets them, then those that are set although no code is known."""
    found: dict[str, ConfiguredParameter] = {}
    every = [one for fact in facts for one in _each(fact, values)]
    for fact in sorted(every, key=lambda one: (_ACCESS.get(one.access, 3), one.evidence)):
        filled = values.fill(fact.name)
        name = values.key(filled.text)
        known = found.get(name)
        if known is not None:
            found[name] = _completed(known, fact)
            continue
        setting = values.set.get(name)
        default = None if fact.default is None else fact.default.usual
        found[name] = _with(
            ConfiguredParameter(
                name, default, fact.type, default, fact.range, fact.access, _proof(fact, filled),
                conditions=as_written(fact.conditions), **_terms_of(fact),
            ),
            setting,
        )  # fmt: skip
    for name, setting in values.set.items():
        if name not in found:
            found[name] = _with(ConfiguredParameter(name, None, setting.type), setting)
    for name, writes in _writes(every, values).items():
        found[name] = after_writes(found[name], writes)
    return tuple(found[name] for name in sorted(found))


def _proof(fact: ParameterFact, filled: Filled) -> Proof:
    """Return where a parameter is declared or read; it is as sure as its name."""
    proof = proof_of(fact.evidence)
    if not fact.name.holes:
        return proof
    sure = Sure.POSSIBLE if filled.text.holes else filled.sure
    how = "; ".join(dict.fromkeys(map(str, (*filled.how, *((proof.how,) if proof.how else ())))))
    return msgspec.structs.replace(proof, sure=sure.value, how=how)


def _writes(facts: Iterable[ParameterFact], values: Values) -> dict[str, list[Write]]:
    """Return what code writes, in the order in which it does, by the names of parameters."""
    found: dict[str, list[Write]] = {}
    for fact in facts:
        if fact.writer is None:
            continue
        value = fact.default if fact.access == "declared" else fact.value
        filled = Filled(Text(), Sure.CERTAIN) if value is None else values.fill(value)
        name = values.fill(fact.name)
        write = Write(fact, None if value is None else filled.text, doubt(filled.sure, name.sure))
        found.setdefault(values.key(name.text), []).append(write)
    return found


def _each(fact: ParameterFact, values: Values) -> Iterator[ParameterFact]:
    """Yield a parameter for each element of a list that its name has a part of."""
    texts = (fact.name,) if fact.default is None else (fact.name, fact.default)
    for name, *default in each_of(texts, values.items_of) if fact.name.holes else (texts,):
        yield msgspec.structs.replace(fact, name=name, default=default[0] if default else None)


def declared_as_set(parameters: Iterable[ConfiguredParameter], proof: Proof) -> tuple[ConfiguredParameter, ...]:
    """Return parameters of a node that declares each that is set for it, ``proof`` being where it is made."""
    return tuple(
        one
        if one.set_by is None or (one.access == "declared" and not one.conditions)
        else msgspec.structs.replace(one, access="declared", proof=one.proof or proof, conditions=())
        for one in parameters
    )


def set_outside(settings: Iterable[Setting]) -> Iterator[ConfiguredParameter]:
    """Yield parameters that a launch file of ROS 1 sets outside of nodes, the last setting of each name."""
    last = {one.name.pattern: one for one in settings}
    for name in sorted(last):
        yield _with(ConfiguredParameter(name, None, last[name].type), last[name])


def _completed(known: ConfiguredParameter, fact: ParameterFact) -> ConfiguredParameter:
    """Return a parameter merged with its properties from a further place of the code."""
    default = known.default if known.default is not None or fact.default is None else fact.default.usual
    value = default if known.value is None and known.set_by is None else known.value
    # The type of the written value does not determine that of the read one.
    kind = fact.type if fact.type and fact.access != "written" and known.type in ("", LIST) else known.type
    others = known.other_types
    if (
        fact.access != "written"
        and fact.type not in (kind, LIST, *others)
        and (fact.type or fact.access == known.access)
    ):
        others = (*others, fact.type)
    if not known.type and kind and known.access == fact.access:
        others = (*others, "")
    more = {} if known.range or known.description else _terms_of(fact)
    return msgspec.structs.replace(
        known, type=kind, default=default, value=value, range=known.range or fact.range, other_types=others, **more
    )


def _terms_of(fact: ParameterFact) -> dict[str, Any]:
    return {"description": fact.description, **msgspec.structs.asdict(fact.terms)}


def _with(parameter: ConfiguredParameter, setting: Setting | None) -> ConfiguredParameter:
    if setting is None:
        return parameter
    return msgspec.structs.replace(parameter, value=setting.value.known, set_type=setting.type, set_by=_set_by(setting))


def _set_by(setting: Setting) -> Proof:
    proof = launch_proof(setting.evidence)
    if setting.value.known is not None:
        return proof
    return msgspec.structs.replace(proof, how=str(setting.value), sure=Sure.POSSIBLE.value)


def _place_of(setting: Setting) -> str:
    return f"{setting.evidence.path}:{setting.evidence.line}"
