"""How far the clock of a host is ahead of the monitor's, and how wrong that may be.

Of four times (asked, received, reported, answered; the first and last on our clock, the others on theirs) the offset is
((received - asked) + (reported - answered)) / 2 and its error at most half the round trip (RFC 5905, section 8).
The exchanges with the shortest round trips met the fewest queues: their mean is taken.
"""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

WINDOW = 32
_GROWN_APART_S = 0.002
"""Clocks of a whole window may have drifted so far."""


class Offset(NamedTuple):
    """Seconds that our clock is ahead of theirs, and the bound of the error."""

    ahead: float
    bound: float


class ClockOffset:
    """The last exchanges of times with the monitor."""

    def __init__(self) -> None:
        self._exchanges: deque[tuple[float, float]] = deque(maxlen=WINDOW)

    def add(self, asked: float, received: float, reported: float, answered: float) -> None:
        """Take an exchange; one that cannot be, an answer before its question for one, is left out."""
        trip = (answered - asked) - (reported - received)
        ahead = -((received - asked) + (reported - answered)) / 2
        if math.isfinite(trip) and math.isfinite(ahead) and trip >= 0 and reported >= received:
            # What contradicts the newest by more than both can be wrong is of before a clock was set.
            agreeing = [one for one in self._exchanges if abs(one[1] - ahead) <= (one[0] + trip) / 2 + _GROWN_APART_S]
            self._exchanges = deque([*agreeing, (trip, ahead)], maxlen=WINDOW)

    def now(self) -> Offset | None:
        """Return the offset; None before the first exchange."""
        if not self._exchanges:
            return None
        best = sorted(self._exchanges)[: max(len(self._exchanges) // 4, 1)]
        mean = sum(ahead for _, ahead in best) / len(best)
        return Offset(mean, best[0][0] / 2)
