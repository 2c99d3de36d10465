"""What a reference asks that a side does not have, or has and should not."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

import msgspec

from roslens.compare.conformance.claim import NODE, PARAMETER, TOPIC
from roslens.compare.conformance.disparity import ABSENT, NOT_KNOWN, Aspect, Disparity, Reason
from roslens.compare.conformance.plumbing import plumbing
from roslens.compare.conformance.side import Side, SideKind
from roslens.judge.patterns.pattern import Pattern
from roslens.judge.ranges.rate import rate
from roslens.judge.reference.alternatives import each
from roslens.judge.reference.constraint_words import expected_words, subject_words
from roslens.judge.reference.expectation import (
    CONDITIONAL,
    Details,
    Presence,
    PresenceMode,
    Reference,
    Selector,
    StateCheck,
    StateOf,
)
from roslens.judge.reference.merge_references import constraints_of
from roslens.judge.reference.pattern_index import PatternIndex
from roslens.judge.reference.same_value import number_of, same_value
from roslens.judge.reference.unmatched import Subject, subjects_of, unmatched
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.verdict import State

_OF_GRAPHS = (EntityKind.NODE, EntityKind.TOPIC, EntityKind.CONNECTION, EntityKind.SERVICE)
_OF_TOPICS = (EntityKind.TOPIC,)
_MOST_NAMED = 5
REFERENCE = "the reference"


def asked(side: Side, sides: Sequence[Side]) -> tuple[list[Disparity], list[str]]:
    """Return the deviations of the others from a reference, and texts on what it has no constraint for."""
    reference = side.reference
    if reference is None:
        return [], []
    here = next(place for place, one in enumerate(sides) if one is side)
    found: list[Disparity] = []
    texts: list[str] = []
    for place, other in enumerate(sides):
        if other.kind is SideKind.REFERENCE or other.graph is None:
            continue
        row = _Row(len(sides), here, place)
        subjects = subjects_of(other.graph)
        kinds = _OF_GRAPHS if NODE in other.knows else _OF_TOPICS
        found += _presences(reference, subjects, kinds, row)
        found += _about_nothing(reference, subjects, kinds, row, other)
        found += _states(reference, other, row)
        texts += _uncovered(reference, other, subjects)
    return _merged(found), texts


def _merged(found: Sequence[Disparity]) -> list[Disparity]:
    """Merge equal disparities of several sides into one with the value of each side and the highest severity."""
    rows: dict[tuple[str, ...], Disparity] = {}
    for one in found:
        key = (one.subject, one.aspect.value, one.reason.value, one.place, one.why)
        other = rows.get(key)
        if other is not None:
            cells = tuple(first or second for first, second in zip(other.values, one.values, strict=True))
            gravest = max(other.severity, one.severity, key=lambda severity: severity.rank)
            one = msgspec.structs.replace(one, values=cells, severity=gravest)
        rows[key] = one
    return [*rows.values()]


def with_asked(found: Sequence[Disparity], asked_: Sequence[Disparity]) -> list[Disparity]:
    """Return differences with what a reference asks; that it misses what differs is reported in its row."""
    missing = {
        (one.kind, one.node, one.name): one
        for one in asked_
        if one.reason is Reason.MISSING and one.aspect is Aspect.EXPECTED
    }
    reported: list[Disparity] = []
    joined: set[tuple[str, str, str]] = set()
    for one in found:
        key = (one.kind, one.node, one.name)
        other = missing.get(key) if one.aspect is Aspect.PRESENCE else None
        if other is None:
            reported.append(one)
            continue
        joined.add(key)
        gravest = max(other.severity, one.severity, key=lambda severity: severity.rank)
        cells = tuple(first or second for first, second in zip(one.values, other.values, strict=True))
        why = f"{one.why} {other.why}"
        reported.append(msgspec.structs.replace(one, values=cells, why=why, severity=gravest))
    left = (one for one in asked_ if one is not missing.get((one.kind, one.node, one.name)))
    return [*reported, *(one for key, one in missing.items() if key not in joined), *left]


class _Row:
    """Makes differences between a reference and one other side."""

    def __init__(self, sides: int, here: int, there: int) -> None:
        self._sides, self._here, self._there = sides, here, there

    def of(
        self, kind: str, name: str, expects: str, is_: str, about: Details, why: str, reason: Reason,
        aspect: Aspect = Aspect.EXPECTED, severity: Severity | None = None,
    ) -> Disparity:  # fmt: skip
        cells = [NOT_KNOWN] * self._sides
        cells[self._here], cells[self._there] = expects, is_
        node, of_it = (name, "") if kind == NODE else ("", name)
        return Disparity(
            kind, node, of_it, aspect, tuple(cells), reason, REFERENCE, why, severity or about.severity, about.where
        )


def _presences(
    reference: Reference, subjects: Sequence[Subject], kinds: Collection[EntityKind], row: _Row
) -> Iterator[Disparity]:
    single = [
        part
        for one in reference.presences
        if one.mode not in CONDITIONAL and one.selector.kind in kinds
        for part in each(one)
    ]
    index = PatternIndex((one.selector, number) for number, one in enumerate(single))
    matched: dict[int, set[str]] = {}
    for subject in subjects:
        for number in _find(index, subject):
            matched.setdefault(number, set()).add(subject.name)
    for number, one in enumerate(single):
        names = sorted(matched.get(number, ()))
        yield from _presence(one, names, row)


def _presence(one: Presence, names: Sequence[str], row: _Row) -> Iterator[Disparity]:
    kind, expects = one.selector.kind.value, expected_words(one)
    if one.mode in (PresenceMode.ALWAYS, PresenceMode.ANY):
        if not names:
            text = f"{one.details.id} expects it to be there. {one.details.text}".strip()
            yield row.of(kind, _name(one.selector), expects, ABSENT, one.details, text, Reason.MISSING)
        return
    if names and one.mode is PresenceMode.NEVER:
        text = f"{one.details.id} does not expect it: {', '.join(names[:_MOST_NAMED])}. {one.details.text}".strip()
        yield row.of(kind, _name(one.selector), expects, "there", one.details, text, Reason.NOT_EXPECTED)


def _name(selector: Selector) -> str:
    return Pattern.parse(selector.name).literal or selector.name


def _about_nothing(
    reference: Reference, subjects: Sequence[Subject], kinds: Collection[EntityKind], row: _Row, other: Side
) -> Iterator[Disparity]:
    for one in unmatched(reference, subjects, kinds):
        about = one.constraint.details
        if isinstance(one.constraint, Presence):
            # What it is there for does not exist either.
            continue
        severity = Severity.NOTE if not other.whole or other.kind is SideKind.SOURCE else Severity.WARNING
        typed = bool(one.selector.type) and " is there, but of type " in one.advice
        text = f"{about.id} is about nothing there. {one.advice}".strip()
        yield row.of(
            one.selector.kind.value, _name(one.selector), f"{subject_words(one.constraint)}: "
            f"{expected_words(one.constraint)}", ABSENT if not typed else "of another type", about, text,
            Reason.MISSING, Aspect.TYPE if typed else Aspect.EXPECTED, Severity.ERROR if typed else severity,
        )  # fmt: skip


def _states(reference: Reference, other: Side, row: _Row) -> Iterator[Disparity]:
    """Yield parameters whose value, and nodes whose lifecycle state, is not the one expected."""
    for check in reference.states:
        index = PatternIndex([(check.selector, 0)])
        for kind, name, is_ in _stated_values(other):
            if (kind is EntityKind.NODE) != (check.of is StateOf.LIFECYCLE):
                continue
            if not is_ or not index.find(kind, name) or _fits(check, is_):
                continue
            text = f"{check.details.id} expects another one. {check.details.text}".strip()
            aspect = Aspect.VALUE if check.of is StateOf.VALUE else Aspect.EXPECTED
            yield row.of(kind.value, name, check.written, is_, check.details, text, Reason.CONTRADICTION, aspect)


def _stated_values(side: Side) -> Iterator[tuple[EntityKind, str, str]]:
    for one in side.claims:
        if one.kind == PARAMETER and one.resolved and not one.conditions:
            yield EntityKind.PARAMETER, f"{one.node}/{one.name}" if one.node else one.name, one.values.get("value", "")
        elif one.kind == NODE and one.lifecycle:
            yield EntityKind.NODE, one.node, one.lifecycle


def _fits(check: StateCheck, is_: str) -> bool:
    if check.range is not None:
        number = number_of(is_)
        return number is not None and rate(number, check.range) is State.OK
    return any(same_value(is_, one) for one in check.allowed)


def _uncovered(reference: Reference, other: Side, subjects: Sequence[Subject]) -> Iterator[str]:
    """Yield how many topics and nodes there are that no constraint is about."""
    index = PatternIndex((selector, 0) for one in constraints_of(reference) if (selector := _about(one)) is not None)
    covered = {(one.kind, one.name) for one in subjects if _find(index, one)}
    for kind, claims in ((EntityKind.NODE, NODE), (EntityKind.TOPIC, TOPIC)):
        if claims not in other.knows:
            continue
        names = _names(other, claims)
        left = [name for name in names if (kind, name) not in covered]
        if left:
            more = f" and {len(left) - _MOST_NAMED} more" if len(left) > _MOST_NAMED else ""
            yield (
                f"No constraint of the reference is about {len(left)} of {len(names)} {kind.value}s of {other.title}: "
                f"{', '.join(left[:_MOST_NAMED])}{more}."
            )


def _names(side: Side, kind: str) -> list[str]:
    return sorted({one.node or one.name for one in side.claims if one.kind == kind and not plumbing(one)})


def _about(constraint: object) -> Selector | None:
    found = getattr(constraint, "selector", None)
    return found if isinstance(found, Selector) else None


def _find(index: PatternIndex[int], subject: Subject) -> Iterable[int]:
    return index.find(
        subject.kind, subject.name, host=subject.host, type=subject.type, publisher=subject.publisher,
        subscriber=subject.subscriber,
    )  # fmt: skip
