"""How long a message waits for the first subscriber: a new publisher has no matched subscribers yet."""

from __future__ import annotations

YOUNG_S = 5.0
"""For this long after its start, discovery may be incomplete, and an empty graph is no evidence."""
_FIRST_S = 1.0
_MATCH_S = 5.0


def patience_s(*, known: bool, first: bool) -> float:
    """Return how many seconds a message waits until its publisher is connected.

    Both ends are connected some time after each has heard of the other, on a busy machine seconds; where their
    qualities of service do not fit they never are, so only the first message of a publisher waits that long.

    Args:
        known: whether the system is known to have a subscription of this topic.
        first: whether nothing was published by this publisher before.
    """
    if first:
        return _MATCH_S if known else _FIRST_S
    return _FIRST_S if known else 0.0
