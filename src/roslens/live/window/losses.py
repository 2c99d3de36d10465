"""How many messages were lost, over as many receipts as that takes to know."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable

from roslens.live.window.bucket import Bucket

LEAST_RECEIPTS = 10
"""A share of lost messages is of so many receipts at least: a subscriber that takes few of many learns at each how many
it missed before, and a window of its publisher's period has none of them, or one."""
LONGEST_S = 60.0
"""What is older shows nothing of the present."""


class Losses:
    """The losses of buckets that have left a window, as many as may be needed beside those in it."""

    __slots__ = ("_before", "_came")

    def __init__(self, before: Iterable[tuple[float, int, int]] = ()) -> None:
        self._before = deque(before)
        self._came = sum(one[2] for one in self._before)

    def twin(self) -> Losses:
        """Return what grows by itself."""
        return Losses(self._before)

    def clear(self) -> None:
        """Forget all of them."""
        self._before.clear()
        self._came = 0

    def keep(self, bucket: Bucket) -> None:
        """Remember a bucket that leaves the window, if losses were counted in it."""
        if not bucket.losses_counted:
            return
        before, end = self._before, bucket.end
        before.append((end, bucket.lost, bucket.losable))
        came = self._came + bucket.losable
        while len(before) > 1 and (came - before[0][2] >= LEAST_RECEIPTS or before[0][0] < end - LONGEST_S):
            came -= before.popleft()[2]
        self._came = came

    def of(self, buckets: Iterable[Bucket], horizon: float) -> tuple[int, int] | None:
        """Return how many messages were lost and how many came, in buckets and before them as far as needed.

        None where that was not counted, and until ``LEAST_RECEIPTS`` came since it is.
        """
        lost, came = 0, 0
        for bucket in buckets:
            lost, came = lost + bucket.lost, came + bucket.losable
        for end, before_lost, before_came in reversed(self._before):
            if came >= LEAST_RECEIPTS or end < horizon - LONGEST_S:
                break
            lost, came = lost + before_lost, came + before_came
        return (lost, came) if came >= LEAST_RECEIPTS else None
