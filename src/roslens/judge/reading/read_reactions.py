"""Reads the reactions of a reference document."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from roslens.judge.documents.document import Section
from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reading.read_action import DO_KEYS, amount_per, read_step
from roslens.judge.reading.read_common_keys import name_of, overrides, reading, visible
from roslens.judge.reading.read_condition_tree import read_condition_tree, seconds
from roslens.judge.reference.condition_contradiction import always, excluding, statements
from roslens.judge.reference.reaction_keys import CONDITION_KEYS, NAMED_CONDITION_KEYS, REACTION_KEYS
from roslens.judge.reference.reference_document import DeclaredReaction, Scope
from roslens.judge.reference.template import fields_in
from roslens.model.acting.condition import Condition, Matching, Not, Stated
from roslens.model.acting.reaction import COOL_DOWN_S, SETTLED_S, Mode, Reaction
from roslens.model.entity import EntityId, EntityKind
from roslens.model.errors import DocumentError
from roslens.plugins.nearest import did_you_mean

MOST_STEPS = 20
MOST_STATEMENTS = 200
"""Of one reaction."""
_ID = re.compile(r"[a-z0-9_][a-z0-9_.-]*\Z")


def read_reactions(document: Section, scope: Scope) -> tuple[DeclaredReaction, ...]:
    """Return the reactions of a document in their order.

    Raises:
        DocumentError: one is wrong, has the id of another, or can never begin.
    """
    named = _Named(document, scope)
    found: dict[str, DeclaredReaction] = {}
    for section in document.sections("reactions", "reaction", REACTION_KEYS):
        one = _reaction(section, scope, named)
        if one.name in found:
            expected = f"one (the first is at {found[one.name].reaction.place})"
            raise section.fault("id", f"a second reaction with id {one.name!r}", expected=expected)
        found[one.name] = one
    named.read_all()
    return tuple(found.values())


class _Named:
    """The named conditions of a document, read when they are asked for."""

    def __init__(self, document: Section, scope: Scope) -> None:
        self._scope = scope
        self._sections: dict[str, Section] = {}
        self._read: dict[str, Condition] = {}
        self._open: list[str] = []
        for section in document.sections("conditions", "named condition", NAMED_CONDITION_KEYS):
            name = name_of(section, section.text("id"))
            if name in self._sections:
                expected = f"one (the first is at {self._sections[name].location('id')})"
                raise section.fault("id", f"a second condition with id {name!r}", expected=expected)
            self._sections[name] = section

    def __call__(self, asking: Section, key: str) -> Condition:
        """Return the condition whose name a section has under ``key``."""
        name = asking.text(key)
        if name not in self._sections:
            valid = list(self._sections)
            expected = f"one of {', '.join(valid)}" if valid else "a condition listed under `conditions`"
            raise asking.fault(key, f"no condition {name[:60]!r}", expected=expected, advice=did_you_mean(name, valid))
        if name in self._open:
            circle = " → ".join((*self._open[self._open.index(name) :], name))
            raise asking.fault(
                key, f"condition {name!r} is about itself: {circle}", expected="conditions without a circle"
            )
        if name not in self._read:
            self._open.append(name)
            section = self._sections[name]
            when = section.section("when", "condition", CONDITION_KEYS)
            if when is None:
                raise section.fault("", f"condition {name!r} without 'when'", expected="the line `when: …`")
            self._read[name] = read_condition_tree(when, self._scope, self)
            self._open.pop()
        return self._read[name]

    def read_all(self) -> None:
        """Read those that nothing asks for, so that what is wrong with them is reported."""
        for name, section in self._sections.items():
            if name not in self._read:
                self(section, "id")


def _reaction(section: Section, scope: Scope, named: _Named) -> DeclaredReaction:
    own = name_of(section, section.text("id"))
    name = f"{scope.prefix}.{own}" if scope.prefix else own
    if not _ID.match(name):
        raise section.fault("id", f"id is {own!r}", expected="small letters, digits, `_`, `-` and `.`")
    conditions = {key: _condition(section, key, scope, named) for key in ("when", "only_while", "unless")}
    when = conditions["when"]
    if when is None:
        raise section.fault("", f"reaction {name!r} without 'when'", expected="the condition on which it is begun")
    steps = tuple(read_step(step, scope) for step in section.sections("do", "step", DO_KEYS))
    if not 1 <= len(steps) <= MOST_STEPS:
        expected = f"1 to {MOST_STEPS} actions, each after a `- `"
        raise section.fault("do", f"reaction {name!r} with {len(steps)} actions", expected=expected)
    at_most, per_s = amount_per(section, "at_most")
    text = visible(section, "text", section.text("text", ""), lines=True)
    reading(section, "text", lambda: fields_in(text))
    reaction = Reaction(
        name=f"{scope.document}.{name}",
        when=when,
        steps=steps,
        only_while=conditions["only_while"],
        unless=conditions["unless"],
        settled_s=seconds(section, "settled", SETTLED_S),
        cool_down_s=seconds(section, "cool_down", COOL_DOWN_S),
        at_most=at_most,
        per_s=per_s,
        mode=section.choice("mode", Mode) if "mode" in section else None,
        text=text,
        place=str(section.location()),
    )
    _refuse_impossible(section, reaction)
    _refuse_unbound(reaction)
    return DeclaredReaction(reaction, name, overrides(section))


def _condition(section: Section, key: str, scope: Scope, named: _Named) -> Condition | None:
    found = section.section(key, "condition", CONDITION_KEYS)
    return read_condition_tree(found, scope, named) if found is not None else None


def _refuse_impossible(section: Section, reaction: Reaction) -> None:
    conditions = [one for one in (reaction.when, reaction.only_while) if one is not None]
    if reaction.unless is not None:
        conditions.append(Not(reaction.unless))
    if sum(1 for one in conditions for _ in statements(one)) > MOST_STATEMENTS:
        raise section.fault("when", "a condition with too many statements", expected=f"at most {MOST_STATEMENTS}")
    if clash := excluding(conditions):
        one, other = clash
        raise DocumentError(
            f"{other.written!r} and {one.written!r} at {one.place}: the reaction can never begin",
            where=other.place,
            expected="statements that can be true together",
        )
    for key, condition in (("when", reaction.when), ("only_while", reaction.only_while)):
        if condition is not None and (pair := always(condition)):
            one, other = pair
            raise DocumentError(
                f"`{key}` is true whatever happens: {other.written!r}, or {one.written!r} at {one.place}, is always so",
                where=other.place,
                expected="a condition that can be false",
            )


def bound(when: Condition) -> Stated | None:
    """Return the statement whose entity a reaction is about: the one with ``match: each``, or the only one.

    None where there are several, or the only one is about whichever of a pattern.
    """
    every = list(statements(when))
    each = [one for one in every if one.matching is Matching.EACH]
    if each:
        return each[0]
    single = len(every) == 1 and Pattern.parse(every[0].selector.name).literal is not None
    return every[0] if single else None


def _refuse_unbound(reaction: Reaction) -> None:
    """Refuse templates of targets that nothing fills, and two statements that both bind."""
    every = [one for part in (reaction.when, reaction.only_while, reaction.unless) if part for one in statements(part)]
    each = [one for one in every if one.matching is Matching.EACH]
    inside = [one for one in _positive(reaction.when) if one.matching is Matching.EACH]
    if len(each) > 1 and each[1] is not each[0]:
        raise DocumentError(
            "a second `match: each`", where=each[1].place, expected=f"one (the first is at {each[0].place})"
        )
    if each and not inside:
        raise DocumentError(
            "`match: each` of what is not asked to be true",
            where=each[0].place,
            expected="it in `when`, below no `not`",
        )
    binding = bound(reaction.when)
    for step in reaction.steps:
        if step.action.target is not None:
            _refuse_target(step.action.target, step.action.place, binding)


def _refuse_target(target: EntityId, place: str, binding: Stated | None) -> None:
    if target.name not in ("{entity}", "{host}"):
        return
    if binding is None:
        raise DocumentError(
            f"{target.name!r} of a reaction that is not about one entity",
            where=place,
            expected="a name, or `match: each` in the statement that it is about",
        )
    if target.name == "{entity}" and binding.selector.kind is not target.kind:
        expected = f"a {target.kind.value}"
        raise DocumentError(f"'{{entity}}' is a {binding.selector.kind.value}", where=place, expected=expected)
    if target.name == "{host}" and binding.selector.kind not in (EntityKind.HOST, EntityKind.NODE, EntityKind.PROCESS):
        raise DocumentError(
            f"'{{host}}' of a {binding.selector.kind.value}", where=place, expected="it of a node, process or host"
        )


def _positive(condition: Condition) -> Iterator[Stated]:
    """Yield the statements of a condition that are not below a ``not``."""
    if isinstance(condition, Stated):
        yield condition
    parts: Sequence[Condition] = () if isinstance(condition, Stated | Not) else condition.parts
    for part in parts:
        yield from _positive(part)
