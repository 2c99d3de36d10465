"""Constraints of a reference, in words."""

from __future__ import annotations

from roslens.judge.reference.alternatives import EACH, alternatives
from roslens.judge.reference.expectation import (
    AgeChain,
    Expectation,
    FieldCheck,
    Presence,
    PresenceMode,
    Selector,
    StateCheck,
)
from roslens.judge.reference.reference_document import ReferenceConstraint
from roslens.model.entity import EntityKind


def selector_words(selector: Selector) -> str:
    """Return ``connection /scan from /lidar to /amcl on robot1, without /tmp``."""
    words = f"{selector.kind.value} {selector.name}"
    for before, pattern in (
        ("of type", selector.type),
        ("from", selector.publisher),
        ("to", selector.subscriber),
        ("on", selector.host),
    ):
        words += f" {before} {pattern}" if pattern else ""
    return words + (f", without {' and '.join(selector.without)}" if selector.without else "")


def subject_words(constraint: ReferenceConstraint) -> str:
    """Return what a constraint is about: entities, a field of messages, a path over topics."""
    if isinstance(constraint, FieldCheck):
        words = selector_words(constraint.selector).removeprefix(f"{EntityKind.TOPIC.value} ")
        return f"field {constraint.field} of {words}"
    if isinstance(constraint, AgeChain):
        return f"data over {' > '.join(constraint.topics)}"
    return selector_words(constraint.selector)


def expected_words(constraint: ReferenceConstraint) -> str:
    """Return what a constraint expects of it: ``rate 25..35 Hz``, ``is there while node /joy is``."""
    if isinstance(constraint, Expectation):
        return f"{constraint.quantity} {constraint.written}"
    if isinstance(constraint, Presence):
        return _presence_words(constraint)
    if isinstance(constraint, AgeChain):
        return f"age {constraint.written}"
    if isinstance(constraint, StateCheck):
        return f"{constraint.of.value} {constraint.written}"
    return _field_words(constraint)


def _presence_words(constraint: Presence) -> str:
    several = constraint.mode in EACH and len(alternatives(constraint.selector.name)) > 1
    if constraint.condition is not None:
        who = "each is" if several else "one is" if constraint.mode is PresenceMode.ANY_WHILE else "is"
        return f"{who} there while {selector_words(constraint.condition)} is"
    return {
        PresenceMode.ALWAYS: "each is always there" if several else "is always there",
        PresenceMode.ANY: "one is always there",
        PresenceMode.NEVER: "is never there",
        PresenceMode.AT_MOST_ONE: "is there at most once",
    }.get(constraint.mode, constraint.mode.value)


def _field_words(constraint: FieldCheck) -> str:
    words = f"{constraint.measure.value} {constraint.written}"
    if (other := constraint.other) is not None:
        words = f"difference to {other.topic + ' ' if other.topic else ''}{other.field} {constraint.written}"
    if (condition := constraint.condition) is not None:
        topic = "" if condition.topic in ("", constraint.topic) else f"{condition.topic} "
        words += f" while {topic}{condition.field} is {condition.range}"
    return words
