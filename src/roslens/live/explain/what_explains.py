"""What the fault of a node can explain, by what is wrong with it."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.live.standing.standing import Standing
from roslens.model.entity import EntityKind
from roslens.model.verdict import State

_INERT = frozenset(
    {
        "memory", "memory_share", "threads", "open_files", "context_switches", "disk_read", "disk_write", "restarts",
    }
)  # fmt: skip
"""What a node has too much of without sending anything else, sooner or later, because of it."""
_LOAD = frozenset({"cpu", "cpu_wait", "stopped", "hung"})
"""What makes a node slower."""
_MORE = frozenset({"rate", "rate_received", "bandwidth", "message_size", "publishers", "subscribers", "misfits"})
"""What is not more because a node is slower."""
_HALTED = frozenset({"stopped", "hung"})


def is_inert(wrong: Iterable[Standing]) -> bool:
    """Whether nothing that is wrong with a node makes anything else wrong."""
    found = [one.quantity for one in wrong]
    return bool(found) and _INERT.issuperset(found)


def is_halted(wrong: Iterable[Standing]) -> bool:
    """Whether a node is stopped or hangs, which nothing that it receives explains."""
    return any(one.quantity in _HALTED for one in wrong)


def may_explain(wrong: Iterable[Standing], faults: Iterable[Standing], kind: EntityKind) -> bool:
    """Return whether what is wrong with an entity of a kind can be why something else is.

    Args:
        wrong: with what would explain it.
        faults: what is to be explained.
        kind: of what would explain it.
    """
    if kind is not EntityKind.NODE or not (quantities := {one.quantity for one in wrong}):
        return True
    too_much = any(one.quantity in _MORE and one.state.state is State.HIGH for one in faults)
    return not (too_much and (_INERT | _LOAD).issuperset(quantities))
