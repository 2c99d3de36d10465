"""How the values of a quantity are distributed: bars of equal width, a last bar for a long tail, key figures."""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence

import msgspec

from roslens.dashboard.charts.figures import number

MOST_BARS = 40
_TAIL = 2.5


class Bar(msgspec.Struct, frozen=True):
    """Values from ``low`` up to (``closed``: and with) ``high``."""

    low: float
    high: float
    count: int
    label: str


class Histogram(msgspec.Struct, frozen=True):
    """Bars and the value axis from ``low`` to ``high``; a tail bar stands beyond ``high``."""

    bars: tuple[Bar, ...]
    low: float
    high: float
    tail: bool

    @property
    def highest(self) -> int:
        """The largest count."""
        return max((bar.count for bar in self.bars), default=0)

    def position(self, value: float) -> float:
        """Return where on the axis the value stands, from 0 to 1, the tail bar included."""
        inner = len(self.bars) - self.tail
        if value > self.high:
            return (inner + 0.5) / len(self.bars) if self.tail else 1.0
        if self.high == self.low:
            return 0.5
        return max(0.0, (value - self.low) / (self.high - self.low) * inner / len(self.bars))


class Figures(msgspec.Struct, frozen=True):
    """Key figures of a sample; ``deviation`` is the sample standard deviation (n - 1)."""

    n: int
    least: float
    median: float
    mean: float
    deviation: float
    p90: float
    most: float


def figures_of(values: Sequence[float]) -> Figures | None:
    """Return the key figures; None for no values."""
    if not values:
        return None
    ordered = sorted(values)
    return Figures(
        n=len(ordered),
        least=ordered[0],
        median=statistics.median(ordered),
        mean=statistics.fmean(ordered),
        deviation=statistics.stdev(ordered) if len(ordered) > 1 else 0.0,
        p90=_quantile(ordered, 0.9),
        most=ordered[-1],
    )


def histogram_of(values: Sequence[float], decimals: int = 0) -> Histogram | None:
    """Return the distribution; None for no values."""
    if not values:
        return None
    ordered = sorted(values)
    whole = all(value == int(value) for value in ordered)
    low, most = ordered[0], ordered[-1]
    bulk = _quantile(ordered, 0.99)
    tail = most - low > _TAIL * (bulk - low) > 0
    width = _nice((bulk if tail else most) - low, whole=whole)
    start = math.floor(low / width) * width
    count = max(1, math.floor(((bulk if tail else most) - start) / width + 1e-9) + 1)
    counts = [0] * (count + tail)
    for value in ordered:
        counts[min(len(counts) - 1, int((value - start) / width + 1e-9))] += 1
    bars = tuple(_bar(start + place * width, width, counts[place], decimals, whole=whole) for place in range(count))
    high = start + count * width
    if tail:
        bars += (Bar(high, most, counts[-1], f"{number(high, decimals)} to {number(most, decimals)}"),)
    return Histogram(bars, start, high, tail)


def _bar(low: float, width: float, count: int, decimals: int, *, whole: bool) -> Bar:
    if whole and width == 1:
        label = number(low)
    elif whole:
        label = f"{number(low)} to {number(low + width - 1)}"
    else:
        digits = max(decimals, max(0, -math.floor(math.log10(width))))
        label = f"{number(low, digits)} to {number(low + width, digits)}"
    return Bar(low, low + width, count, label)


def _nice(span: float, *, whole: bool) -> float:
    """Return 1, 2 or 5 times a power of ten, wide enough for at most ``MOST_BARS`` bars."""
    if span <= 0:
        return 1.0
    raw = span / (MOST_BARS - 1)
    power = 10.0 ** math.floor(math.log10(raw))
    width = next(step * power for step in (1, 2, 5, 10) if step * power >= raw)
    return max(1.0, width) if whole else width


def _quantile(ordered: Sequence[float], part: float) -> float:
    """Return the value below or at which ``part`` of the values lie (nearest rank)."""
    return ordered[max(0, math.ceil(part * len(ordered)) - 1)]
