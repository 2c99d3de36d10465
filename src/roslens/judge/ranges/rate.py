"""Rating: where a value stands to its range."""

from __future__ import annotations

from roslens.judge.ranges.range import Range
from roslens.model.verdict import State


def rate(value: float | None, range_: Range) -> State:
    """Return how ``value`` stands to ``range_``.

    Bounds are fine themselves: only a value above the maximum is high, only one below the minimum low.
    A value that is missing or not a number is unknown.
    """
    if value is None or value != value:
        return State.UNKNOWN
    if range_.maximum is not None and value > range_.maximum:
        return State.HIGH
    if range_.minimum is not None and value < range_.minimum:
        return State.LOW
    return State.OK
