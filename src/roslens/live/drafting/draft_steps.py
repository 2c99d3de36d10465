"""What was seen of one publisher on one topic, step by step of an observation."""

from __future__ import annotations

from array import array
from collections.abc import Sequence

import msgspec

from roslens.model.traffic.tally import Tally


class Track(msgspec.Struct, frozen=True):
    """The times between the messages of one publisher, by step, from the step of the topic's first message on.

    Attributes:
        intervals: how many ended in each step.
        spans: seconds that these took together.
        gaps: the longest of them; at the end also the one that goes on.
        period: mean of all of them in seconds.
    """

    intervals: Sequence[float]
    spans: Sequence[float]
    gaps: Sequence[float]
    period: float


class Steps:
    """Collects what one observer reports about one connection.

    Attributes:
        messages: in all.
        periods: times between messages.
        time_between: their sum in seconds.
    """

    def __init__(self) -> None:
        self.messages = 0
        self.periods = 0
        self.time_between = 0.0
        self._number = array("l")
        self._intervals = array("d")
        self._span = array("d")
        self._gap = array("d")
        self._filled: tuple[int, int] | None = None

    def add(self, tally: Tally, shares: Sequence[tuple[int, float]]) -> None:
        """Take a tally that covers steps by these shares; its longest gap is one of the last of them."""
        if not tally.count:
            return
        period = tally.period
        for number, share in shares:
            self._number.append(number)
            self._intervals.append(period.count * share)
            self._span.append(period.total * share if period.count else 0.0)
            self._gap.append(period.greatest if period.count and number == shares[-1][0] else 0.0)
        self.messages += tally.count
        self.periods += period.count
        self.time_between += period.total if period.count else 0.0
        first, last = shares[0][0], shares[-1][0]
        known = self._filled or (first, last)
        self._filled = min(first, known[0]), max(last, known[1])

    @property
    def first(self) -> int:
        """Number of the first step with a message."""
        return self._filled[0] if self._filled else 0

    def track(self, first: int, end: int, step_s: float) -> Track:
        """Return the times between messages in the steps from ``first`` up to ``end``."""
        intervals, spans, gaps = ([0.0] * (end - first) for _ in range(3))
        for number, count, span, gap in zip(self._number, self._intervals, self._span, self._gap, strict=True):
            place = number - first
            intervals[place] += count
            spans[place] += span
            gaps[place] = max(gaps[place], gap)
        last = self._filled[1] if self._filled else first
        # It is unknown where in its step the last message came; whole steps without any are surely silent.
        gaps[-1] = max(gaps[-1], (end - 1 - last) * step_s)
        return Track(intervals, spans, gaps, self.time_between / self.periods if self.periods else 0.0)
