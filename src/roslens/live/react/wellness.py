"""Whether the monitor itself is fit to decide anything: not just begun, in time, and by a clock that goes on."""

from __future__ import annotations

from roslens.live.join.session import Step

BEGINNING_S = 5.0
"""So long after it begins nothing is decided: what was not seen yet looks like what is gone."""
LATE_S = 1.0
"""A look that comes so long after the one before was late, unless all of them are as rare."""
_USUAL_TIMES = 5
RECOVERING_S = 3.0
"""So long after something was wrong with the monitor nothing is decided: what waited has to be read, and judged."""
_BACK_S = 0.05


class Wellness:
    """Determines why a monitor is not fit to decide; fed with each step in order."""

    def __init__(self, start: float) -> None:
        """Begin at ``start``, in seconds on the monitor's clock."""
        self._start = start
        self._last = start
        self._usual = 0.0
        self._shed = 0
        self._until = float("-inf")
        self._reason = ""

    def look(self, step: Step, now: float) -> str:
        """Return why nothing can be decided at ``now``; empty where it can."""
        gap, self._last = now - self._last, now
        if gap < -_BACK_S:
            self._start = min(self._start, now)
            self._ail(now, f"the monitor's clock was set back by {-gap:.1f} s")
        elif gap > max(LATE_S, _USUAL_TIMES * self._usual):
            self._ail(now, f"the monitor looked {gap:.1f} s after the look before")
        elif gap > 0:
            self._usual = gap if not self._usual else 0.9 * self._usual + 0.1 * gap
        if step.shed > self._shed:
            self._ail(now, f"observers dropped {step.shed - self._shed} records")
        self._shed = step.shed
        if not step.begun:
            return "observers do not see yet"
        if now - self._start < BEGINNING_S:
            return "the monitor has just begun"
        return self._reason if now < self._until else ""

    def _ail(self, now: float, reason: str) -> None:
        self._until, self._reason = now + RECOVERING_S, reason
