"""Whether time runs, stands or jumped: the clock of a simulation or recording does all three."""

from __future__ import annotations

from enum import Enum

_BACK_S = 0.05
_LEAP_S = 10.0
_LEAP_TICKS = 20
_STANDING = 3
_KNOWN = 10


class Course(str, Enum):
    """How time went on since the tick before."""

    RUNS = "runs"
    STANDS = "stands"
    JUMPED = "jumped"


class ClockWatch:
    """Finds pauses and jumps of the time at which a monitor is asked.

    Time stands when it is the same in three ticks in a row after the first. It jumped when it went back by more than
    0.05 s, or forth by more than 10 s and 20 times the usual. Attribute ``now`` is the latest time.
    """

    __slots__ = ("_same", "_ticks", "_usual", "now")

    def __init__(self, start: float) -> None:
        self.now = start
        self._same = self._ticks = 0
        self._usual = 0.0

    def tick(self, now: float) -> Course:
        """Take the time of a tick."""
        step = now - self.now
        if step < -_BACK_S:
            return self._jumped(now)
        if step <= 0:
            self._same += 1
            return Course.STANDS if self._same >= _STANDING else Course.RUNS
        if self._ticks >= _KNOWN and step > max(_LEAP_S, _LEAP_TICKS * self._usual):
            return self._jumped(now)
        self._same = 0
        self._ticks += 1
        self._usual = step if self._ticks == 1 else 0.9 * self._usual + 0.1 * step
        self.now = now
        return Course.RUNS

    def _jumped(self, now: float) -> Course:
        self.now = now
        self._same = 0
        return Course.JUMPED
