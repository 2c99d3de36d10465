"""The traffic of a connection in one stretch of time, as a window keeps it."""

from __future__ import annotations

import msgspec

from roslens.model.tally import Moments, Tally


class Bucket(msgspec.Struct, gc=False):
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
        gap_at: when that began, as well as it is known.
        bytes: of the messages whose size is known.
        sized: how many messages those are.
        lost: messages known to be lost.
        losable: messages that came where losses were counted.
        losses_counted: whether losses were counted at all.
        period: moments of the times between messages.
        latency: of the times from publishing to receipt.
        age: of the times from the stamp to receipt.
        processing: of the times from receipt to the answer.
    """

    start: float
    end: float
    count: int
    first: float
    last: float
    intervals: int
    span: float
    gap: float
    gap_at: float
    bytes: int
    sized: int
    lost: int
    losable: int
    losses_counted: bool
    period: Moments
    latency: Moments
    age: Moments
    processing: Moments

    @classmethod
    def of(cls, tally: Tally, previous: float) -> Bucket:
        """Take a tally; ``previous`` is when the last message before it came, 0 where unknown."""
        period, count, first = tally.period, tally.count, tally.first
        intervals, span = period.count, period.total
        gap, gap_at = -1.0, tally.start
        if intervals:
            gap, gap_at = period.greatest, tally.longest_at
            if not gap_at:
                gap_at = _begun(tally, gap, previous)
        if intervals < count and first:
            # The observer did not count every time between messages: first and last tell some of them.
            if not intervals and count > 1:
                intervals, span = count - 1, tally.last - first
                gap = span / intervals
            if previous and first > previous and intervals < count:
                intervals += 1
                span += first - previous
                if first - previous > gap:
                    gap, gap_at = first - previous, previous
        size, lost = tally.bytes, tally.lost
        return cls(
            tally.start, tally.end, count, first, tally.last, intervals, span, gap, gap_at,
            max(size, 0), count if size >= 0 else 0, max(lost, 0), count if lost >= 0 else 0, lost >= 0,
            period, tally.latency, tally.age, tally.processing,
        )  # fmt: skip

    def absorb(self, later: Bucket) -> None:
        """Become the bucket of both; ``later`` begins where this one ends."""
        self.end = later.end
        self.first = self.first or later.first
        self.last = later.last or self.last
        self.count += later.count
        self.intervals += later.intervals
        self.span += later.span
        if later.gap > self.gap:
            self.gap, self.gap_at = later.gap, later.gap_at
        self.bytes += later.bytes
        self.sized += later.sized
        self.lost += later.lost
        self.losable += later.losable
        self.losses_counted |= later.losses_counted
        self.period = joined(self.period, later.period)
        self.latency = joined(self.latency, later.latency)
        self.age = joined(self.age, later.age)
        self.processing = joined(self.processing, later.processing)


def _begun(tally: Tally, gap: float, previous: float) -> float:
    """Return when the longest time between messages may have begun: in the middle of where it fits."""
    earliest = previous or tally.first or tally.start
    latest = max((tally.last or tally.end) - gap, earliest)
    return (earliest + latest) / 2


def joined(one: Moments, other: Moments) -> Moments:
    """Return the moments of both, without building anything where one is empty."""
    if not other.count:
        return one
    return one.merged(other) if one.count else other
