"""Contradictions: constraints of which no system can keep both."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import combinations

import msgspec

from roslens.judge.patterns.common_name import common_name
from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.alternatives import each
from roslens.judge.reference.constraint_words import expected_words, subject_words
from roslens.judge.reference.expectation import (
    AgeChain,
    Expectation,
    FieldCheck,
    Presence,
    PresenceMode,
    Selector,
    StateCheck,
)
from roslens.judge.reference.reference_document import Declared, ReferenceConstraint
from roslens.judge.reference.same_value import number_of, same_value
from roslens.model.errors import DocumentError

_ADVICE = "Replace one (`override: true` with its `id`), or leave names out of it with `without`"
_NEEDED = (PresenceMode.ALWAYS, PresenceMode.ANY)


class Contradiction(msgspec.Struct, frozen=True):
    """Two constraints that exclude each other.

    Attributes:
        first: that stands earlier.
        second: that stands later.
        entity: one that both are about; empty where none could be named.
        where: ``file:line:column`` of the second.
        other: ``file:line:column`` of the first.
    """

    first: ReferenceConstraint
    second: ReferenceConstraint
    entity: str
    where: str
    other: str

    def error(self) -> DocumentError:
        """Return it as an error that names both places."""
        both = f"; both are about {self.entity!r}" if self.entity else ""
        return DocumentError(
            f"{self.second.details.id!r} ({subject_words(self.second)}: {expected_words(self.second)}) contradicts "
            f"{self.first.details.id!r} ({subject_words(self.first)}: {expected_words(self.first)}) at {self.other}"
            f"{both}",
            where=self.where,
            expected="constraints that can hold together",
            advice=_ADVICE,
        )


def contradictions(declared: Sequence[Declared]) -> Iterator[Contradiction]:
    """Yield the pairs among ``declared`` that exclude each other, in their order."""
    groups: dict[tuple[object, ...], list[Declared]] = defaultdict(list)
    for one in declared:
        groups[_theme(one.constraint)].append(one)
    for group in groups.values():
        for first, second in _suspects(group):
            entity = _clash(first.constraint, second.constraint)
            if entity is not None:
                yield Contradiction(first.constraint, second.constraint, entity, second.place, first.place)


def _suspects(group: Sequence[Declared]) -> Iterator[tuple[Declared, Declared]]:
    """Yield the pairs that are worth a closer look: of a thousand constraints only few share a name."""
    constraints = [one.constraint for one in group]
    modes = {one.mode for one in constraints if isinstance(one, Presence)}
    if modes and not (PresenceMode.NEVER in modes and modes.intersection(_NEEDED)):
        return
    expectations = [constraint for constraint in constraints if isinstance(constraint, Expectation)]
    if len(expectations) < len(group) or len({one.percentile for one in expectations}) > 1:
        yield from combinations(group, 2)
        return
    names = [Pattern.parse(one.selector.name) for one in expectations]
    lows = [-math.inf if one.range.minimum is None else one.range.minimum for one in expectations]
    highs = [math.inf if one.range.maximum is None else one.range.maximum for one in expectations]
    for at, (low, high) in enumerate(zip(lows, highs, strict=True)):
        apart = [other for other in range(at + 1, len(group)) if lows[other] > high or highs[other] < low]
        for other in apart:
            if names[at].intersects(names[other]):
                yield group[at], group[other]


def meeting_name(one: Selector, other: Selector) -> str | None:
    """Return the name of an entity that both select, None where no entity can be.

    The name is empty where one may exist but could not be found.
    """
    if one.kind is not other.kind:
        return None
    for mine, theirs in (
        (one.host, other.host),
        (one.type, other.type),
        (one.publisher, other.publisher),
        (one.subscriber, other.subscriber),
    ):
        if mine and theirs and not Pattern.parse(mine).intersects(Pattern.parse(theirs)):
            return None
    names = [Pattern.parse(one.name), Pattern.parse(other.name)]
    return common_name(names, [Pattern.parse(text) for text in (*one.without, *other.without)])


def _theme(constraint: ReferenceConstraint) -> tuple[object, ...]:
    """Return what two constraints share that could exclude each other."""
    if isinstance(constraint, Expectation):
        return ("signal", constraint.selector.kind, constraint.quantity)
    if isinstance(constraint, Presence):
        return ("presence", constraint.selector.kind)
    if isinstance(constraint, AgeChain):
        return ("chain", constraint.topics)
    if isinstance(constraint, StateCheck):
        return ("state", constraint.selector.kind, constraint.of)
    return ("field", constraint.field, constraint.condition, constraint.measure, constraint.other)


def _clash(one: ReferenceConstraint, other: ReferenceConstraint) -> str | None:
    """Return an entity on which two constraints exclude each other; empty for unknown, None where they do not."""
    if isinstance(one, Expectation) and isinstance(other, Expectation):
        return meeting_name(one.selector, other.selector) if _apart(one, other) else None
    if isinstance(one, Presence) and isinstance(other, Presence):
        return _presences_clash(one, other)
    if isinstance(one, StateCheck) and isinstance(other, StateCheck):
        return None if _states_meet(one, other) else meeting_name(one.selector, other.selector)
    if isinstance(one, FieldCheck | AgeChain) and isinstance(other, FieldCheck | AgeChain):
        return _values_clash(one, other)
    return None


def _presences_clash(one: Presence, other: Presence) -> str | None:
    needed, never = (one, other) if other.mode is PresenceMode.NEVER else (other, one)
    if needed.mode not in _NEEDED or never.mode is not PresenceMode.NEVER:
        return None
    banned = (_forbidden(single.selector, never.selector) for single in each(needed))
    return next((name for name in banned if name is not None), None)


def _values_clash(one: FieldCheck | AgeChain, other: FieldCheck | AgeChain) -> str | None:
    if one.range.overlaps(other.range):
        return None
    if isinstance(one, FieldCheck) and isinstance(other, FieldCheck):
        return meeting_name(one.selector, other.selector)
    return one.topics[-1] if isinstance(one, AgeChain) else None


def _states_meet(one: StateCheck, other: StateCheck) -> bool:
    """Whether a text or number can be fine for both."""
    if one.range is not None and other.range is not None:
        return one.range.overlaps(other.range)
    if one.range is None and other.range is None:
        return any(same_value(mine, theirs) for mine in one.allowed for theirs in other.allowed)
    ranged, listed = (one, other) if one.range is not None else (other, one)
    numbers = [number for text in listed.allowed if (number := number_of(text)) is not None]
    return ranged.range is not None and any(number in ranged.range for number in numbers)


def _apart(one: Expectation, other: Expectation) -> bool:
    """Whether no window can satisfy both; a lower percentile is never above a higher one."""
    if one.percentile == other.percentile:
        return not one.range.overlaps(other.range)
    if not one.percentile or not other.percentile:
        return False
    lower, higher = (one, other) if one.percentile < other.percentile else (other, one)
    least, most = lower.range.minimum, higher.range.maximum
    return least is not None and most is not None and least > most


def _forbidden(always: Selector, never: Selector) -> str | None:
    """Return a name where all that ``always`` could mean is what must never be, else None."""
    wider = (
        (always.host, never.host),
        (always.type, never.type),
        (always.publisher, never.publisher),
        (always.subscriber, never.subscriber),
    )
    if not all(_covers(theirs, mine) for mine, theirs in wider):
        return None
    wanted, banned = Pattern.parse(always.name), Pattern.parse(never.name)
    spared = [Pattern.parse(text) for text in always.without]
    # One name that is wanted and not banned is enough to keep both.
    if common_name([wanted], [banned, *spared]) is not None:
        return None
    if any(common_name([wanted, Pattern.parse(text)], spared) is not None for text in never.without):
        return None
    return common_name([wanted, banned], spared)


def _covers(outer: str, inner: str) -> bool:
    """Whether a pattern surely matches all that another does; an empty one matches everything."""
    if not outer or outer == inner:
        return True
    return bool(inner) and common_name([Pattern.parse(inner)], [Pattern.parse(outer)]) is None
