"""What reading may cost: CPU, messages and bytes a second, kept by pausing; pure."""

from __future__ import annotations

import msgspec

BURST_S = 4.0
"""So many seconds' worth may be spent at once."""
LEAST_PAUSE_S = 1.0


class Limits(msgspec.Struct, frozen=True):
    """Most that may be spent on average: CPU as share of one core, messages and bytes a second."""

    cpu: float = 0.05
    messages: float = 5_000.0
    bytes: float = 50e6


class Budget:
    """Buckets that fill with time and empty with use; when one is empty, reading pauses until it is full again.

    So a topic that costs three times too much is watched a third of the time, at its full rate.

    Attributes:
        paused: whether reading has to rest.
        why: what was spent, in words, when the pause began.
    """

    def __init__(self, limits: Limits, now: float) -> None:
        self._rates = (limits.cpu, limits.messages, limits.bytes)
        self._left = [rate * BURST_S for rate in self._rates]
        self._time = now
        self._since = now
        self._spent = [0.0, 0.0, 0.0]
        self.paused = False
        self.why = ""

    def spend(self, cpu: float, messages: int, size: int, now: float) -> bool:
        """Note what was used since the last time; return whether reading has to rest from now on."""
        passed = max(now - self._time, 0.0)
        self._time = now
        for place, used in enumerate((cpu, messages, size)):
            self._spent[place] += used
            full = self._rates[place] * BURST_S
            self._left[place] = min(self._left[place] + self._rates[place] * passed, full) - used
        if self.paused:
            rested = now - self._since >= LEAST_PAUSE_S
            full = all(left >= rate * BURST_S * 0.5 for left, rate in zip(self._left, self._rates, strict=True))
            if rested and full:
                self._turn(False, now)
        elif min(self._left) < 0:
            self.why = self._words(now - self._since)
            self._turn(True, now)
        return self.paused

    def _turn(self, paused: bool, now: float) -> None:
        self.paused = paused
        self._since = now
        self._spent = [0.0, 0.0, 0.0]

    def _words(self, seconds: float) -> str:
        seconds = max(seconds, 1e-3)
        cpu, messages, size = (spent / seconds for spent in self._spent)
        most = f"{self._rates[0]:.1%}, {self._rates[1]:,.0f} messages/s and {self._rates[2] / 1e6:,.1f} MB/s"
        return f"{cpu:.1%} of a core, {messages:,.0f} messages/s and {size / 1e6:,.1f} MB/s where {most} are allowed"
