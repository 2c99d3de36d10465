"""Constraints on lifecycle states and values of parameters."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.judge.documents.document import Section
from roslens.judge.ranges.amount import parse_limits
from roslens.judge.ranges.range import Range
from roslens.judge.reading.read_common_keys import declared, details_of, visible
from roslens.judge.reference.expectation import Selector, StateCheck, StateOf
from roslens.judge.reference.reference_document import Declared, Scope
from roslens.judge.reference.reference_keys import STATE_KEYS
from roslens.model.entity import EntityKind
from roslens.plugins.nearest import did_you_mean

_KINDS = {StateOf.LIFECYCLE: EntityKind.NODE, StateOf.VALUE: EntityKind.PARAMETER}
LIFECYCLE = (
    "unconfigured", "inactive", "active", "finalized", "configuring", "cleaningup", "shuttingdown", "activating",
    "deactivating", "errorprocessing",
)  # fmt: skip
"""The states of managed nodes and of their transitions (lifecycle_msgs/msg/State)."""


def has_states(section: Section) -> bool:
    """Return whether a constraint is about states."""
    return any(key in section for key in STATE_KEYS)


def read_state_checks(section: Section, scope: Scope, selector: Selector, name: str) -> Iterator[Declared]:
    """Yield what a constraint expects of states and values.

    Raises:
        DocumentError: the kind of entity has none, or a state is none.
    """
    for of, kind in _KINDS.items():
        key = of.value
        if key not in section:
            continue
        if selector.kind is not kind:
            raise section.fault(key, f"{key!r} of a {selector.kind.value}", expected=f"it of a {kind.value}")
        texts = tuple(visible(section, key, text) for text in section.texts(key))
        if not texts:
            raise section.fault(key, f"{key} is empty", expected="what is fine")
        if of is StateOf.LIFECYCLE and (wrong := [text for text in texts if text not in LIFECYCLE]):
            expected = f"one of {', '.join(LIFECYCLE)}"
            advice = did_you_mean(wrong[0], LIFECYCLE)
            raise section.fault(key, f"{key} is {wrong[0]!r}", expected=expected, advice=advice)
        limits = number_range(texts) if of is StateOf.VALUE else None
        check = StateCheck(
            details=details_of(section, scope, name, key, key),
            selector=selector,
            of=of,
            allowed=() if limits is not None else texts,
            range=limits,
            written=" or ".join(texts),
        )
        yield declared(section, scope, check, name, key)


def number_range(texts: tuple[str, ...]) -> Range | None:
    """Return the range that a single text is; None where it is a value."""
    text = texts[0]
    if len(texts) > 1 or not (".." in text or text.startswith(("<", ">"))):
        return None
    try:
        limits = parse_limits(text, "")
    except ValueError:
        return None
    return None if limits.percentile else limits.range
