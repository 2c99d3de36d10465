"""The traffic of a connection in one stretch of time, as a window keeps it."""

from __future__ import annotations

from copy import copy
from typing import Union

import msgspec

from roslens.model.traffic.tally import Moments, Tally
from roslens.model.traffic.tally_columns import Row


class Sums:
    """Moments that grow in place, so that taking more in builds nothing."""

    __slots__ = ("count", "greatest", "least", "squares", "total")

    def __init__(self, count: int, total: float, squares: float, least: float, greatest: float) -> None:
        self.count = count
        self.total = total
        self.squares = squares
        self.least = least
        self.greatest = greatest

    @classmethod
    def of(cls, one: Moments) -> Sums:
        """Begin with what is known."""
        return cls(one.count, one.total, one.squares, one.least, one.greatest)

    def take(self, other: Moments | Sums) -> None:
        """Become the moments of both series together; both have some."""
        self.count += other.count
        self.total += other.total
        self.squares += other.squares
        if other.least < self.least:
            self.least = other.least
        if other.greatest > self.greatest:
            self.greatest = other.greatest

    @property
    def mean(self) -> float | None:
        """The mean; None of nothing."""
        return self.total / self.count if self.count else None

    @property
    def deviation(self) -> float | None:
        """The standard deviation of the population; None of nothing."""
        return Moments(self.count, self.total, self.squares).deviation


Series = Union[Moments, Sums]  # noqa: UP007 - read at run time by Python 3.10 too


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
        gap_at: when that began, 0 where unknown.
        before: when the last message before the first came; that of the first where unknown.
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
    before: float
    bytes: int
    sized: int
    lost: int
    losable: int
    losses_counted: bool
    period: Series
    latency: Series
    age: Series
    processing: Series

    @classmethod
    def of(cls, tally: Tally, previous: float) -> Bucket:
        """Take a tally; ``previous`` is when the last message before it came, 0 where unknown."""
        period, count, first = tally.period, tally.count, tally.first
        intervals, span, gap, gap_at = _times_between(tally, previous)
        size, lost = tally.bytes, tally.lost
        sized, losses = size >= 0, lost >= 0
        return cls(
            tally.start, tally.end, count, first, tally.last, intervals, span, gap, gap_at, previous or first,
            size if sized else 0, count if sized else 0, lost if losses else 0, count if losses else 0, losses,
            period, tally.latency, tally.age, tally.processing,
        )  # fmt: skip

    @classmethod
    def of_row(cls, row: Row, previous: float) -> Bucket:
        """Take a tally that counted messages and every time between them; ``previous`` as in :meth:`of`."""
        start, end, count, size, first, last, period, latency, age, lost, _, _, processing, longest_at = row
        sized, losses = size >= 0, lost >= 0
        return cls(
            start, end, count, first, last, count, period.total, period.greatest, longest_at, previous or first,
            size if sized else 0, count if sized else 0, lost if losses else 0, count if losses else 0, losses,
            period, latency, age, processing,
        )  # fmt: skip

    def extend_row(self, row: Row, previous: float) -> None:
        """Take a tally as :meth:`of_row` does, which begins where this bucket ends."""
        _, end, count, size, first, last, period, latency, age, lost, _, _, processing, longest_at = row
        gap = self.gap
        if gap >= 0 and not self.gap_at:
            self.gap_at = self.gap_began
        self.end = end
        self.first = self.first or first
        if last:
            self.last = last
        self.count += count
        if size >= 0:
            self.bytes += size
            self.sized += count
        if lost >= 0:
            self.lost += lost
            self.losable += count
            self.losses_counted = True
        self.intervals += count
        self.span += period.total
        if period.greatest > gap:
            self.gap, self.gap_at, self.before = period.greatest, longest_at, previous or first
        sums = self.period
        if type(sums) is Sums:
            sums.take(period)
        else:
            self.period = joined(sums, period)
        if latency.count:
            self.latency = joined(self.latency, latency)
        if age.count or processing.count:
            self.age = joined(self.age, age)
            self.processing = joined(self.processing, processing)

    def twin(self) -> Bucket:
        """Return a bucket that grows by itself."""
        one = copy(self)
        one.period, one.latency = copy(self.period), copy(self.latency)
        one.age, one.processing = copy(self.age), copy(self.processing)
        return one

    @property
    def gap_began(self) -> float:
        """When the longest time between messages began; where that is unknown, in the middle of where it fits."""
        if self.gap_at:
            return self.gap_at
        earliest = self.before or self.start
        return (earliest + max((self.last or self.end) - self.gap, earliest)) / 2

    def extend(self, tally: Tally, previous: float) -> None:
        """Take a tally that begins where this one ends."""
        period, count, first = tally.period, tally.count, tally.first
        intervals, size, lost = period.count, tally.bytes, tally.lost
        if intervals < count and first:
            self.absorb(Bucket.of(tally, previous))
            return
        if not self.gap_at and self.gap >= 0:
            self.gap_at = self.gap_began
        self.end = tally.end
        if count:
            self.first = self.first or first
            self.last = tally.last or self.last
            self.count += count
        if size >= 0:
            self.bytes += size
            self.sized += count
        if lost >= 0:
            self.lost += lost
            self.losable += count
            self.losses_counted = True
        if intervals:
            self.intervals += intervals
            self.span += period.total
            if period.greatest > self.gap:
                self.gap, self.gap_at, self.before = period.greatest, tally.longest_at, previous or first
            self.period = joined(self.period, period)
        self.latency = joined(self.latency, tally.latency)
        if tally.age.count or tally.processing.count:
            self.age = joined(self.age, tally.age)
            self.processing = joined(self.processing, tally.processing)

    def absorb(self, later: Bucket) -> None:
        """Become the bucket of both; ``later`` begins where this one ends."""
        if later.gap > self.gap:
            self.gap, self.gap_at = later.gap, later.gap_began
        elif self.gap >= 0:
            self.gap_at = self.gap_began
        self.end = later.end
        self.first = self.first or later.first
        self.last = later.last or self.last
        self.count += later.count
        self.intervals += later.intervals
        self.span += later.span
        self.bytes += later.bytes
        self.sized += later.sized
        self.lost += later.lost
        self.losable += later.losable
        self.losses_counted |= later.losses_counted
        self.period = joined(self.period, later.period)
        self.latency = joined(self.latency, later.latency)
        self.age = joined(self.age, later.age)
        self.processing = joined(self.processing, later.processing)


def _times_between(tally: Tally, previous: float) -> tuple[int, float, float, float]:
    """Return how many times between messages a tally has, their sum, the longest one and when it began.

    The longest is -1 where unknown. Where the observer did not count each of them, first and last tell some.
    """
    period, count, first = tally.period, tally.count, tally.first
    intervals, span, gap_at = period.count, period.total, tally.longest_at
    gap = period.greatest if intervals else -1.0
    if intervals >= count or not first:
        return intervals, span, gap, gap_at
    if not intervals and count > 1:
        intervals, span = count - 1, tally.last - first
        gap = span / intervals
    if previous and first > previous and intervals < count:
        intervals += 1
        span += first - previous
        if first - previous > gap:
            gap, gap_at = first - previous, previous
    return intervals, span, gap, gap_at


def joined(one: Series, other: Series) -> Series:
    """Return the moments of both: ``one``, grown, where it can grow and both have some."""
    if not other.count:
        return one
    if not one.count:
        # What still grows elsewhere must not grow here.
        return other if type(other) is Moments else copy(other)
    grown = one if type(one) is Sums else Sums.of(one)  # type: ignore[arg-type]
    grown.take(other)
    return grown
