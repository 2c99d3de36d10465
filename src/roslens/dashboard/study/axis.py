"""Where values stand on an axis of a plot, evenly or by their logarithm."""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec

from roslens.dashboard.charts.figures import compact

_THOUSAND = 1000


class Axis(msgspec.Struct, frozen=True):
    """From ``low`` to ``high`` over ``length`` units of a drawing, which begins at ``start``."""

    low: float
    high: float
    start: float
    length: float
    logarithmic: bool = False

    def place(self, value: float) -> float:
        """Return where a value stands, rounded to tenths."""
        low, high, seen = self._seen(self.low), self._seen(self.high), self._seen(value)
        part = (seen - low) / (high - low) if high > low else 0.5
        return round(self.start + part * self.length, 1)

    def ends(self) -> tuple[tuple[float, str], ...]:
        """Return the places of both ends with what is written there."""
        return (self.place(self.low), _written(self.low)), (self.place(self.high), _written(self.high))

    def _seen(self, value: float) -> float:
        return math.log1p(max(value, 0)) if self.logarithmic else value


def _written(value: float) -> str:
    text = compact(value)
    return f"{float(text):,.0f}" if abs(value) >= _THOUSAND else text


def axis_of(values: Sequence[float], start: float, length: float, *, logarithmic: bool = False) -> Axis:
    """Return an axis on which all values stand; values are there."""
    return Axis(min(values), max(values), start, length, logarithmic)
