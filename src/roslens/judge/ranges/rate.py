"""Rating: where a value stands to its range."""

from __future__ import annotations

from enum import Enum

from roslens.judge.ranges.range import Range


class Rating(str, Enum):
    """What a value means against a range."""

    UNKNOWN = "unknown"
    OK = "ok"
    LOW = "low"
    HIGH = "high"


def rate(value: float | None, range_: Range) -> Rating:
    """Return how ``value`` stands to ``range_``.

    Bounds are fine themselves: only a value above the maximum is high, only one below the minimum low.
    A value that is missing or not a number is unknown.
    """
    if value is None or value != value:
        return Rating.UNKNOWN
    if range_.maximum is not None and value > range_.maximum:
        return Rating.HIGH
    if range_.minimum is not None and value < range_.minimum:
        return Rating.LOW
    return Rating.OK
