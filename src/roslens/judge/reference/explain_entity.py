"""Which constraints of references are about an entity, and which would be if more were known of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import msgspec

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.ranges.amount import Limits, limits_text
from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import AgeChain, Expectation, FieldCheck, Presence, Selector, StateCheck
from roslens.judge.reference.merge_references import Merged
from roslens.judge.reference.reference_document import Declared, ReferenceConstraint
from roslens.judge.reference.unmatched import Subject
from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity


class Applied(msgspec.Struct, frozen=True):
    """A constraint about an entity.

    Attributes:
        declared: the constraint and where it stands.
        provided: what must be true of the entity besides, in words; empty for nothing.
        role: how the entity takes part, where it is not what the constraint judges.
        replaced_by: where the constraint stands that took its place; empty where it holds.
    """

    declared: Declared
    provided: str = ""
    role: str = ""
    replaced_by: str = ""


def explain_entity(merged: Merged, subject: Subject) -> tuple[Applied, ...]:
    """Return the constraints about an entity: those that hold in the order of the documents, then those replaced.

    Args:
        merged: documents that were merged.
        subject: the entity; what is empty of it is unknown.
    """
    found = [applied for one in merged.standing for applied in _applied(one, subject)]
    for old, new in merged.replaced:
        found += [msgspec.structs.replace(applied, replaced_by=new.place) for applied in _applied(old, subject)]
    return tuple(found)


def combined(applied: tuple[Applied, ...], known: Mapping[str, Quantity]) -> dict[str, str]:
    """Return the range that is left of each signal that several constraints are about, in words, by its key."""
    ranges: dict[str, list[Range]] = {}
    for one in applied:
        constraint = one.declared.constraint
        if isinstance(constraint, Expectation) and not (constraint.percentile or one.provided or one.replaced_by):
            ranges.setdefault(constraint.quantity, []).append(constraint.range)
    return {key: _left(several, known[key].unit) for key, several in ranges.items() if len(several) > 1}


def _left(ranges: Iterable[Range], unit: str) -> str:
    """Return in words what lies in all of the ranges."""
    together = Range()
    for one in ranges:
        shared = together.intersect(one)
        if shared is None:
            return "nothing"
        together = shared
    return limits_text(Limits(together), unit)


def _applied(declared: Declared, subject: Subject) -> Iterator[Applied]:
    constraint = declared.constraint
    if isinstance(constraint, Expectation | Presence | StateCheck):
        provided = _provided(constraint.selector, subject)
        if provided is not None:
            yield Applied(declared, provided)
    role = _role(constraint, subject)
    if role is not None:
        yield Applied(declared, role=role)


def _provided(selector: Selector, subject: Subject) -> str | None:
    """Return what must be true besides for a selector to select an entity; None where it cannot."""
    if selector.kind is not subject.kind or not Pattern.parse(selector.name).matches(subject.name):
        return None
    if any(Pattern.parse(text).matches(subject.name) for text in selector.without):
        return None
    conditions = []
    for word, pattern, given in (
        ("host", selector.host, subject.host),
        ("type", selector.type, subject.type),
        ("publisher", selector.publisher, subject.publisher),
        ("subscriber", selector.subscriber, subject.subscriber),
    ):
        if pattern and not given:
            conditions.append(f"its {word} is {pattern}")
        elif pattern and not Pattern.parse(pattern).matches(given):
            return None
    return " and ".join(conditions)


def _role(constraint: ReferenceConstraint, subject: Subject) -> str | None:
    """Return how an entity takes part in a constraint that is not about it alone; None where it does not."""
    if isinstance(constraint, Presence):
        condition = constraint.condition
        return "it is the condition" if condition and _provided(condition, subject) == "" else None
    if subject.kind is not EntityKind.TOPIC or isinstance(constraint, Expectation | StateCheck):
        return None
    if isinstance(constraint, AgeChain):
        if subject.name not in constraint.topics:
            return None
        return f"it is topic {constraint.topics.index(subject.name) + 1} of {len(constraint.topics)}"
    return _field_role(constraint, subject)


def _field_role(constraint: FieldCheck, subject: Subject) -> str | None:
    if _provided(constraint.selector, subject) is not None:
        return ""
    if constraint.other is not None and subject.name == constraint.other.topic:
        return "it is compared with"
    enabled_by = constraint.condition.topic if constraint.condition else ""
    return "it holds the condition" if subject.name == enabled_by else None
