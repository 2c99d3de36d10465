"""A reference drafted from what was observed, for a person to edit: each line with its evidence.

Of each topic, per window of a second or of five periods, whichever is longer:

- ``rate``: from the 1st to the 99th percentile of the windows, wider by the greatest of a tenth of the median, three
  interquartile ranges and one message a window;
- ``largest_gap``: at most a quarter above the 95th percentile of the windows, and never less than two and a half
  mean periods, so that one message that is missing is no alarm.

Of several publishers of a topic the messages add up, and the longest of their gaps is that of the topic, as in what
is judged. Percentiles, not extremes: what happened a few times in a recording is what one wants to be told of.
"""

from __future__ import annotations

import math
import statistics
from array import array
from collections.abc import Iterable, Sequence
from itertools import pairwise

import msgspec

from roslens.judge.range import Range
from roslens.live.window import RANK
from roslens.model.tally import Tally

LEAST_WINDOWS = 5
"""A topic with fewer windows says too little to draft anything from."""
LEAST_MESSAGES = 10
PERIODS = 5
GAP_PERCENTILE, GAP_MARGIN, GAP_PERIODS = 95, 1.25, 2.5
RATE_SHARE, RATE_SPREADS = 0.1, 3.0
LONGEST_S = 600.0
"""Of a tally; what is longer is taken as if all of it came at the end."""


class Line(msgspec.Struct, frozen=True):
    """One drafted range.

    Attributes:
        quantity: key of the signal.
        range: that is proposed, in the unit of the signal.
        typical: median over the windows.
        windows: how many windows it was drafted from.
        outside: how many of them lie outside the range.
        hours: the time that the windows cover.
    """

    quantity: str
    range: Range
    typical: float
    windows: int
    outside: int
    hours: float

    @property
    def alarms_per_hour(self) -> float:
        """Expected alarms an hour: those seen, or where there are none the most that 95 % confidence allows.

        Of an event that did not happen in n trials the probability is below 3/n (rule of three, Hanley 1983).
        """
        return (self.outside or 3.0) / self.hours


class Drafted(msgspec.Struct, frozen=True):
    """What is proposed of one topic, or of several of one pattern."""

    names: tuple[str, ...]
    type: str
    messages: int
    seconds: float
    lines: tuple[Line, ...]


class _Steps:
    """What was seen of one connection by one observer, per step of the observation."""

    def __init__(self) -> None:
        self.number = array("l")
        self.count = array("d")
        self.gap = array("d")
        self.messages = 0
        self.periods = 0
        self.time_between = 0.0

    def add(self, tally: Tally, shares: Sequence[tuple[int, float]]) -> None:
        """Take a tally that covers steps by these shares; its longest gap is one of the last of them."""
        gap = tally.period.greatest if tally.period.count else 0.0
        for number, share in shares:
            self.number.append(number)
            self.count.append(tally.count * share)
            self.gap.append(gap if number == shares[-1][0] else 0.0)
        self.messages += tally.count
        self.periods += tally.period.count
        self.time_between += tally.period.total


_View = tuple[int, bool, str]
"""How well somebody sees a connection, whether at its subscriber, and which."""


class Observed:
    """Collects the tallies that a reference is drafted from."""

    def __init__(self, step_s: float = 1.0) -> None:
        """Take tallies in steps of ``step_s`` seconds."""
        self.step_s = step_s
        self._steps: dict[str, dict[str, dict[_View, _Steps]]] = {}
        self._types: dict[str, str] = {}
        self._number = 0
        self._start: float | None = None

    def add(self, tallies: Iterable[Tally]) -> None:
        """Take the tallies of the next step, of a recording."""
        for tally in tallies:
            self._of(tally).add(tally, ((self._number, 1.0),))
        self._number += 1

    def add_live(self, tallies: Iterable[Tally]) -> None:
        """Take tallies of any stretches of time; their messages are spread over the steps that they cover."""
        for tally in tallies:
            if self._start is None:
                self._start = tally.start
            shares = self._shares(tally.start - self._start, tally.end - self._start)
            if shares:
                self._of(tally).add(tally, shares)
                self._number = max(self._number, shares[-1][0] + 1)

    def _shares(self, start: float, end: float) -> list[tuple[int, float]]:
        """Return the steps that a stretch of time covers, each with its share of the stretch."""
        if end <= 0 or end < start or end - start > LONGEST_S:
            # Before everything else, or of a clock that jumped.
            return []
        start = max(start, 0.0)
        first, last = math.floor(start / self.step_s), max(math.ceil(end / self.step_s) - 1, 0)
        if last <= first:
            return [(first, 1.0)]
        edges = [start, *(number * self.step_s for number in range(first + 1, last + 1)), end]
        spans = pairwise(edges)
        return [(first + place, (after - before) / (end - start)) for place, (before, after) in enumerate(spans)]

    def add_types(self, types: Iterable[tuple[str, str]]) -> None:
        """Take the types of topics by name."""
        self._types.update(types)

    def drafted(self) -> tuple[Drafted, ...]:
        """Return what is proposed, one entry a topic, sorted by name."""
        found = []
        for topic, publishers in sorted(self._steps.items()):
            best = [self._best(views) for name, views in sorted(publishers.items()) if name or len(publishers) == 1]
            lines = self._lines(best)
            if lines:
                seconds, messages = self._number * self.step_s, sum(one.messages for one in best)
                found.append(Drafted((topic,), self._types.get(topic, ""), messages, seconds, lines))
        return tuple(found)

    def left_out(self) -> tuple[str, ...]:
        """Return the topics of which too little was seen."""
        drafted = {name for one in self.drafted() for name in one.names}
        return tuple(sorted({*self._steps, *self._types} - drafted))

    def _of(self, tally: Tally) -> _Steps:
        views = self._steps.setdefault(tally.topic, {}).setdefault(tally.publisher, {})
        view = (RANK[tally.observer], bool(tally.subscriber), tally.subscriber)
        return views.setdefault(view, _Steps())

    @staticmethod
    def _best(views: dict[_View, _Steps]) -> _Steps:
        """Return where the traffic of a publisher is seen best: subscribers of one publisher do not add up."""
        return min(views.items(), key=lambda pair: (not pair[1].messages, *pair[0][:2], -pair[1].messages))[1]

    def _lines(self, publishers: Sequence[_Steps]) -> tuple[Line, ...]:
        spoken = [one for one in publishers if one.messages >= LEAST_MESSAGES and one.periods and one.time_between]
        if not spoken:
            return ()
        period = max(one.time_between / one.periods for one in spoken)
        size = max(math.ceil(PERIODS * period / self.step_s), 1)
        # The first and last windows hold the beginning and end of the recording, which is no fault of the topic.
        counts, gaps = self._windows(spoken, size)
        counts, gaps = counts[1:-1], gaps[1:-1]
        if len(counts) < LEAST_WINDOWS:
            return ()
        seconds = size * self.step_s
        hours = len(counts) * seconds / 3600
        rates = [count / seconds for count in counts]
        return (
            _line("rate", rates, _rate_range(rates, seconds), hours),
            _line("largest_gap", gaps, _gap_range(gaps, period), hours),
        )

    def _windows(self, publishers: Sequence[_Steps], size: int) -> tuple[list[float], list[float]]:
        first = min(min(one.number) for one in publishers)
        last = max(max(one.number) for one in publishers)
        counts = [0.0] * ((last - first) // size + 1)
        gaps = [0.0] * len(counts)
        for one in publishers:
            for number, count, gap in zip(one.number, one.count, one.gap, strict=True):
                window = (number - first) // size
                counts[window] += count
                gaps[window] = max(gaps[window], gap)
        return counts, gaps


def _line(quantity: str, values: Sequence[float], proposed: Range, hours: float) -> Line:
    outside = sum(value not in proposed for value in values)
    return Line(quantity, proposed, statistics.median(values), len(values), outside, hours)


def _rate_range(rates: Sequence[float], seconds: float) -> Range:
    median = statistics.median(rates)
    spread = percentile(rates, 75) - percentile(rates, 25)
    margin = max(RATE_SHARE * median, RATE_SPREADS * spread, 1 / seconds)
    least = max(percentile(rates, 1) - margin, 0.0)
    greatest = percentile(rates, 99) + margin
    return Range(rounded(least, up=False) or None, rounded(greatest, up=True))


def _gap_range(gaps: Sequence[float], period: float) -> Range:
    bound = max(GAP_MARGIN * percentile(gaps, GAP_PERCENTILE), GAP_PERIODS * period)
    return Range(maximum=rounded(bound, up=True))


def percentile(values: Sequence[float], share: float) -> float:
    """Return the percentile of ``values`` by linear interpolation between the nearest of them."""
    ordered = sorted(values)
    place = (len(ordered) - 1) * share / 100
    low = math.floor(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (ordered[high] - ordered[low]) * (place - low)


def rounded(value: float, *, up: bool, digits: int = 3) -> float:
    """Return ``value`` with so many significant digits, rounded outward."""
    if value <= 0:
        return 0.0
    scale = 10.0 ** (digits - 1 - math.floor(math.log10(value)))
    # A value that is round already stays, though its product with the scale may be off by a last bit.
    whole = math.ceil(value * scale - 1e-9) if up else math.floor(value * scale + 1e-9)
    return whole / scale
