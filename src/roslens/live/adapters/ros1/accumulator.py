"""What a reader sees of one stream of messages, until it is taken."""

from __future__ import annotations

import struct

from roslens.model.traffic.tally import NOTHING, Moments, Observer, Tally

_HEAD = struct.Struct("<III")
_LEAP = 1_000_000
"""A sequence number that leaps so far began anew."""


class Spread:
    """Moments that grow."""

    __slots__ = ("count", "greatest", "least", "squares", "total")

    def __init__(self) -> None:
        self.count = 0
        self.total = self.squares = 0.0
        self.least = float("inf")
        self.greatest = float("-inf")

    def add(self, value: float) -> None:
        """Add a value."""
        self.count += 1
        self.total += value
        self.squares += value * value
        self.least = min(self.least, value)
        self.greatest = max(self.greatest, value)

    def moments(self) -> Moments:
        """Return what was added so far."""
        if not self.count:
            return NOTHING
        return Moments(self.count, self.total, self.squares, self.least, self.greatest)


class Accumulator:
    """Counts messages of one publisher of one topic.

    Sequence numbers tell of lost messages only where they grow: a publisher that leaves them at 0 tells nothing.

    Args:
        topic: read.
        publisher: name of its node.
        stamped: whether messages begin with sequence number and stamp.
        start: seconds on the observer's clock.
    """

    def __init__(self, topic: str, publisher: str, stamped: bool, start: float) -> None:
        self._topic = topic
        self._publisher = publisher
        self._stamped = stamped
        self._sequence = -1
        self._counts_up = False
        self._newest = 0.0
        self._begin(start)

    def _begin(self, start: float) -> None:
        self._start = start
        self._count = self._bytes = self._lost = 0
        self._first = self._last = self._longest_at = 0.0
        self._period = Spread()
        self._age = Spread()

    def message(self, size: int, head: bytes, time: float) -> None:
        """Count a message of ``size`` bytes that came at ``time``."""
        self._count += 1
        self._bytes += size
        if self._newest:
            gap = max(time - self._newest, 0.0)
            if gap > self._period.greatest:
                self._longest_at = self._newest
            self._period.add(gap)
        self._first = self._first or time
        self._last = self._newest = time
        if self._stamped and len(head) >= _HEAD.size:
            sequence, seconds, nanoseconds = _HEAD.unpack_from(head)
            if seconds or nanoseconds:
                self._age.add(time - seconds - nanoseconds * 1e-9)
            if self._sequence >= 0:
                gap = (sequence - self._sequence) % 2**32
                self._counts_up = self._counts_up or 0 < gap < _LEAP
                if 1 < gap < _LEAP:
                    self._lost += gap - 1
            self._sequence = sequence

    def take(self, now: float, host: str) -> Tally:
        """Return what came since the start, and start anew."""
        tally = Tally(
            self._topic, self._publisher, "", self._start, max(now, self._start), self._count, self._bytes,
            self._first, self._last, self._period.moments(), age=self._age.moments(),
            lost=self._lost if self._counts_up else -1, observer=Observer.TAP, host=host,
            longest_at=self._longest_at,
        )  # fmt: skip
        self._begin(max(now, self._start))
        return tally
