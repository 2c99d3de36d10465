"""The traffic of a connection in one stretch of time, as a window keeps it."""

from __future__ import annotations

from roslens.model.tally import Moments, Tally


class Bucket:
    """One tally, or several neighbouring ones together.

    Attributes:
        start: on the observer's clock.
        end: on it too.
        count: messages.
        first: when the first came, 0 where unknown.
        last: when the last came, 0 where unknown.
        intervals: times between messages that ended here.
        span: their sum in seconds.
        gap: the longest of them; -1 where unknown.
        bytes: of the messages whose size is known.
        sized: how many messages those are.
        lost: messages known to be lost.
        losable: messages that came where losses were counted.
        losses_counted: whether losses were counted at all.
    """

    __slots__ = (
        "age",
        "bytes",
        "count",
        "end",
        "first",
        "gap",
        "intervals",
        "last",
        "latency",
        "losable",
        "losses_counted",
        "lost",
        "period",
        "processing",
        "sized",
        "span",
        "start",
    )

    def __init__(self, tally: Tally, previous: float) -> None:
        """Take a tally; ``previous`` is when the last message before it came, 0 where unknown."""
        self.start = tally.start
        self.end = tally.end
        self.count = count = tally.count
        self.first = first = tally.first
        self.last = tally.last
        self.period = period = tally.period
        self.latency = tally.latency
        self.age = tally.age
        self.processing = tally.processing
        self.intervals = period.count
        self.span = period.total
        self.gap = period.greatest if period.count else -1.0
        if period.count < count and first:
            self._complete(first - previous if previous else 0.0)
        known = tally.bytes
        self.bytes, self.sized = (known, count) if known >= 0 else (0, 0)
        lost = tally.lost
        self.losses_counted = lost >= 0
        self.lost, self.losable = (lost, count) if lost >= 0 else (0, 0)

    def _complete(self, before: float) -> None:
        """Take the times that the observer did not count from first and last; ``before`` is that before the first."""
        if not self.intervals and self.count > 1:
            self.intervals = self.count - 1
            self.span = self.last - self.first
            self.gap = self.span / self.intervals
        if before > 0 and self.intervals < self.count:
            self.intervals += 1
            self.span += before
            self.gap = max(self.gap, before)

    def absorb(self, later: Bucket) -> None:
        """Become the bucket of both; ``later`` begins where this one ends."""
        self.end = later.end
        self.first = self.first or later.first
        self.last = later.last or self.last
        self.count += later.count
        self.intervals += later.intervals
        self.span += later.span
        self.gap = max(self.gap, later.gap)
        self.bytes += later.bytes
        self.sized += later.sized
        self.lost += later.lost
        self.losable += later.losable
        self.losses_counted |= later.losses_counted
        self.period = joined(self.period, later.period)
        self.latency = joined(self.latency, later.latency)
        self.age = joined(self.age, later.age)
        self.processing = joined(self.processing, later.processing)


def joined(one: Moments, other: Moments) -> Moments:
    """Return the moments of both, without building anything where one is empty."""
    if not other.count:
        return one
    return one.merged(other) if one.count else other
