"""From values to steps of the colour ramp, relative to what is visible: the darkest step holds the worst value shown.

``web/graph/ramp.js`` does the same in the browser when filters change; a browser test holds the two together.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import msgspec

from roslens.dashboard.charts.figures import number
from roslens.model.quantity import Better

STEPS = 5
NO_DATA = "n"
"""Step of a package without a value: hatched, never white."""


class Ramp(msgspec.Struct, frozen=True):
    """Steps that grow with the square from 0 to ``most``; if falling, equal ones from ``most`` down to ``least``.

    Squares, because counts of findings are skewed: equal steps would put nearly all packages into the palest.
    """

    least: float = 0.0
    most: float = 0.0
    falling: bool = False
    whole: bool = True
    decimals: int = 0

    def step(self, value: float | None) -> str:
        """Return ``n`` (no data), ``0`` (zero) or ``1`` to ``5``."""
        if value is None:
            return NO_DATA
        if self.falling:
            span = self.most - self.least
            return str(min(STEPS, 1 + int(STEPS * (self.most - value) / span))) if span else "1"
        if value <= 0 or self.most <= 0:
            return "0"
        return str(max(1, min(STEPS, math.ceil(STEPS * math.sqrt(value / self.most) - 1e-9))))

    def legend(self) -> list[tuple[str, str]]:
        """Return (step, the numbers it stands for), palest first, without steps that no whole number falls into."""
        if self.falling:
            width = (self.most - self.least) / STEPS
            ends = [(self.most - (step + 1) * width, self.most - step * width) for step in range(STEPS)]
            return [(str(step + 1), self._range(low, high)) for step, (low, high) in enumerate(ends)]
        found = [("0", "0")]
        for step in range(1, STEPS + 1):
            low, high = (self.most * (edge / STEPS) ** 2 for edge in (step - 1, step))
            if self.whole:
                first, last = math.floor(low + 1e-9) + 1, math.floor(high + 1e-9)
                if first <= last:
                    found.append((str(step), self._range(first, last)))
            elif self.most > 0:
                found.append((str(step), self._range(low, high)))
        return found

    def _range(self, low: float, high: float) -> str:
        first, last = number(low, self.decimals), number(high, self.decimals)
        return first if first == last else f"{first} to {last}"


def ramp_of(values: Iterable[float | None], better: Better = Better.LOWER, decimals: int = 0) -> Ramp:
    """Return the ramp for the visible values."""
    known = [value for value in values if value is not None]
    if not known:
        return Ramp()
    whole = decimals == 0 and all(value == int(value) for value in known)
    falling = better is Better.HIGHER
    return Ramp(min(known), max(known), falling, whole, decimals if not whole else 0)
