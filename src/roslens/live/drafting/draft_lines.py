"""The ranges that are proposed of a topic: its typical band, in windows that are long enough for it to be one.

Rates are taken as they are judged: times between messages by their sum, in windows of five seconds or twenty periods,
whichever is longer, or of twice or four times that where only they are steady. A window before the first message is
none. A topic that leaves its band oftener than `alarms_allowed` comes with events rather than at a rate.

- ``rate``: around the median of the windows, by as much as a silence that the other line lets pass can change a window,
  and as windows differ. Where that is a quarter or more, or windows differ by more, from three quarters to nine fifths:
  without a third of its messages, or with twice as many, a topic is outside even so.
- ``largest_gap``: a little more than the longest gap that may well come again, which is the one after as many as
  `alarms_allowed`: what comes once is what one wants to hear of. Never less than four periods (two and a half of a slow
  topic on which nothing was missing), nor than a hiccup: eight times that gap, but at least a quarter of a second and
  at most so long that a second of silence is reported.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterator, Sequence
from itertools import accumulate

import msgspec

from roslens.judge.ranges.range import Range
from roslens.live.drafting.draft_steps import Track

WINDOW_S = 5.0
PERIODS = 20
"""How many a window holds at least."""
LONGEST_S = 120.0
"""Of a window."""
STRETCHED = (1, 2, 4)
"""How many times as long windows are tried."""
LEAST_WINDOWS = 2
LESS, MORE = 0.75, 1.8
"""Of the median: the bounds of the widest band."""
LEAST_WIDTH = 0.1
"""Of the median: a band is no narrower to either side, since timers of a busy machine differ by some percent."""
SPREADS = 3.0
"""Standard deviations of the windows, by their quartiles, that have to fit between the median and the lower bound."""
GAP_PERIODS, GAP_SHARE = 4.0, 1.15
WHOLE_PERIODS, WHOLE, WHOLE_MESSAGES = 2.5, 1.25, 200
"""A slow topic of which so many messages came and none was missing twice, which no gap of so many periods shows, is
given fewer periods: four of them would hide a second of silence."""
SLOWEST_S = 0.5
"""Mean time between messages up to which a second of silence is more than what any of them takes."""
FEW, CHANCE = 200, 0.5
"""Messages in a window up to which is asked whether they come by chance, and from which share of its variance on."""
LEAST_SINGLES = 10
IRREGULAR = 0.6
"""Standard deviation of single times between messages, as share of their mean, from which on they are events: those of
events that come by chance have 1, those of a timer that loses a fifth of its messages 0.4."""
HICCUP_S, HICCUP_SHARE = (0.25, 0.95), 8.0
"""Between which times a hiccup is taken to be none, and how many times as long as what may well come again it is."""
ALARMS_AN_HOUR = 2.0


class Line(msgspec.Struct, frozen=True):
    """One drafted range.

    Attributes:
        quantity: key of the signal.
        range: that is proposed, in the unit of the signal.
        typical: median over the windows.
        outside: how often what was observed left the range.
        hours: that it was observed for.
    """

    quantity: str
    range: Range
    typical: float
    outside: int
    hours: float

    @property
    def alarms_per_hour(self) -> float:
        """Expected alarms an hour."""
        return expected_alarms(self.outside, self.hours)


def expected_alarms(times: int, hours: float) -> float:
    """Return alarms an hour: those seen, or where there are none the most that 95 % confidence allows.

    Of an event that did not happen in n trials the probability is below 3/n (rule of three, Hanley 1983).
    """
    return (times or 3.0) / hours


class Proposed(msgspec.Struct, frozen=True):
    """What is proposed of a topic: lines judged in windows of so many seconds, or why there are none."""

    lines: tuple[Line, ...] = ()
    window: float = 0.0
    unsteady: str = ""


def alarms_allowed(hours: float) -> int:
    """Return how often a range may be left in so many hours: once, or at the rate that is promised."""
    return max(1, math.floor(ALARMS_AN_HOUR * hours))


def proposed(tracks: Sequence[Track], step_s: float) -> Proposed | None:
    """Return what is proposed of a topic with these publishers; None where too little was seen."""
    steps = len(tracks[0].intervals)
    period = max(track.period for track in tracks)
    usual = max(math.ceil(max(WINDOW_S, PERIODS * period) / step_s), 1)
    if steps < usual + LEAST_WINDOWS - 1:
        return None
    if usual * step_s > LONGEST_S:
        return Proposed(unsteady=f"a message in {period:.3g} s")
    hours = steps * step_s / 3600
    why, chance = "", _irregular(tracks, step_s)
    for times in STRETCHED:
        size = usual * times
        if size * step_s > LONGEST_S or steps < size * (1 if times == 1 else 2):
            break
        rates = list(_rates(tracks, size, step_s))
        # Longer windows overlap too much to show it.
        chance = chance or (times == 1 and _by_chance(rates, size * step_s))
        lines = () if chance else _steady(tracks, rates, size * step_s, hours)
        if lines:
            return Proposed(lines, size * step_s)
        why = why or f"{min(rates):.3g} to {max(rates):.3g} Hz in windows of {size * step_s:g} s"
    return Proposed(unsteady=why)


def _steady(tracks: Sequence[Track], rates: Sequence[float], window: float, hours: float) -> tuple[Line, ...]:
    """Return the lines of a topic with these rates in windows of so many seconds; none where they are not steady."""
    allowed, typical, spread = alarms_allowed(hours), statistics.median(rates), _spread(rates)
    band = Range(rounded(LESS * typical, up=False), rounded(MORE * typical, up=True))
    outside = _times_outside(rates, band)
    if not typical or outside > allowed or SPREADS * spread > (1 - LESS) * typical:
        return ()
    gaps = _gaps(tracks, allowed, hours)
    narrow = _narrow(typical, spread, (gaps.range.maximum or 0.0) / window)
    if narrow is not None and _times_outside(rates, narrow) <= outside:
        band = narrow
    return Line("rate", band, typical, outside, hours), gaps


def _rates(tracks: Sequence[Track], size: int, step_s: float) -> Iterator[float]:
    """Yield the rate of the topic in every window of so many steps."""
    sums = [(list(accumulate(one.intervals, initial=0.0)), list(accumulate(one.spans, initial=0.0))) for one in tracks]
    for start in range(len(tracks[0].intervals) - size + 1):
        total = 0.0
        for track, (counted, spent) in zip(tracks, sums, strict=True):
            count, span = counted[start + size] - counted[start], spent[start + size] - spent[start]
            # A silence that goes on has no end yet that would count it.
            quiet = span < size * step_s - step_s - 2 * track.period
            total += count / (size * step_s if quiet else span) if span > 0 else 0.0
        yield total


def _narrow(typical: float, spread: float, silent: float) -> Range | None:
    """Return the band that a silence of so large a share of a window stays in; None where that is no narrower."""
    width = max(silent + SPREADS * spread / typical, LEAST_WIDTH)
    if width >= 1 - LESS:
        return None
    return Range(rounded((1 - width) * typical, up=False), rounded((1 + width) * typical, up=True))


def _by_chance(rates: Sequence[float], seconds: float) -> bool:
    """Whether rates waver as those of events do that come by chance: the variance of their number is its mean."""
    count = statistics.median(rates) * seconds
    return count <= FEW and (_spread(rates) * seconds) ** 2 > CHANCE * count


def _irregular(tracks: Sequence[Track], step_s: float) -> bool:
    """Whether the messages of a slow topic come by chance: so slow that each time between two of them is known."""
    singles = [
        span
        for track in tracks
        if track.period >= 2 * step_s
        for count, span in zip(track.intervals, track.spans, strict=True)
        if count == 1
    ]
    return len(singles) >= LEAST_SINGLES and statistics.pstdev(singles) > IRREGULAR * statistics.fmean(singles)


def _spread(values: Sequence[float]) -> float:
    """Return the standard deviation that a normal distribution with the same quartiles has."""
    low, _, high = statistics.quantiles(values, n=4, method="inclusive")
    return (high - low) / 1.349


def _times_outside(values: Sequence[float], band: Range) -> int:
    inside = [value in band for value in values]
    return sum(not now and before for before, now in zip([True, *inside], inside, strict=False))


def _gaps(tracks: Sequence[Track], allowed: int, hours: float) -> Line:
    longest = [max(gaps) for gaps in zip(*(track.gaps for track in tracks), strict=True)]
    ordered = sorted(longest, reverse=True)
    again = ordered[allowed] if len(ordered) > allowed else 0.0
    hiccup = min(max(HICCUP_S[0], HICCUP_SHARE * again), HICCUP_S[1])
    bound = max(hiccup, _missing(tracks, again), GAP_SHARE * again)
    range_ = Range(maximum=rounded(bound, up=True))
    typical = statistics.median([gap for gap in longest if gap] or [0.0])
    return Line("largest_gap", range_, typical, sum(gap not in range_ for gap in longest), hours)


def _missing(tracks: Sequence[Track], again: float) -> float:
    """Return how long nothing comes where as many messages are missing as are let pass."""
    period = max(track.period for track in tracks)
    slow = HICCUP_S[1] < GAP_PERIODS * period and period <= SLOWEST_S
    seen = sum(map(sum, (track.intervals for track in tracks)))
    if slow and seen >= WHOLE_MESSAGES and again <= WHOLE * period:
        return WHOLE_PERIODS * period
    return GAP_PERIODS * period


def rounded(value: float, *, up: bool, digits: int = 3) -> float:
    """Return ``value`` with so many significant digits, rounded outward."""
    if value <= 0:
        return 0.0
    scale = 10.0 ** (digits - 1 - math.floor(math.log10(value)))
    # A value that is round already stays, though its product with the scale may be off by a last bit.
    whole = math.ceil(value * scale - 1e-9) if up else math.floor(value * scale + 1e-9)
    return whole / scale
