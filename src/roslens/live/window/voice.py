"""Who observes, as the monitor hears it: up to when each has looked, and whether it is silent.

A connection of which nothing is reported was silent only if its observer says that it has looked; an observer of which
nothing is heard may be stopped, or the line to it cut, while everything it observes goes on.
"""

from __future__ import annotations

LEAST_PATIENCE_S = 1.5
"""No observer is silent that was heard of within this time."""
_TURNS = 3
"""An observer is silent that has missed so many of its turns."""
_SLACK_S = 0.2
_DRIFT = 0.001
"""Clocks drift apart by less than this."""


class Voice:
    """One observer; times are on the monitor's clock, but for ``looked``.

    Attributes:
        name: by which it calls itself: ``<host>/<what it observes>``.
        of_graph: whether it tells who is there.
        last_received: when something of it was received last.
        lag: by how many seconds what was received last came later than usual, because it waited for a line.
        silent: whether nothing was heard of it for longer than it usually takes.
        since: when it began to be silent, or to speak.
    """

    __slots__ = (
        "_base", "_fresh", "_looked", "_looked_at", "_spacing", "lag", "last_received", "name", "of_graph", "silent",
        "since",
    )  # fmt: skip

    def __init__(self, name: str, now: float) -> None:
        """Begin to listen at ``now``."""
        self.name = name
        self.of_graph = False
        self.last_received = self.since = self._looked_at = now
        self.silent = False
        self._fresh = False
        self._looked = 0.0
        self._base = float("inf")
        self.lag = 0.0
        self._spacing = 0.0

    def hear(self, looked: float) -> None:
        """Note that it spoke, and up to when it has looked on its own clock; 0 where it did not say."""
        self._fresh = True
        if looked:
            self._looked = looked

    def settle(self, now: float) -> bool:
        """Bring it to ``now``; return whether it fell silent, or speaks again."""
        if not self._fresh:
            if self.silent or now - self.last_received <= self.patience:
                return False
            self.silent, self.since = True, self.last_received
            return True
        self._fresh = False
        gap = now - self.last_received
        if self._looked:
            self._take_looked(now)
        was, self.silent = self.silent, False
        self.last_received = now
        if was:
            self.since = now
        else:
            self._spacing = max(min(gap, self.patience), 0.9 * self._spacing)
        return was

    @property
    def patience(self) -> float:
        """Seconds after which an observer of which nothing is heard is silent."""
        return max(LEAST_PATIENCE_S, _TURNS * self._spacing)

    def behind(self, now: float) -> float:
        """Return the seconds up to ``now`` of which it has not reported what it saw."""
        return max(now - self._looked_at, 0.0) + self.lag

    def forgive(self, seconds: float) -> None:
        """Do not count a time in which the monitor itself was not there to hear."""
        self.last_received += seconds

    def shift(self, now: float) -> None:
        """Begin anew, because the time of the monitor itself broke."""
        self.last_received = self._looked_at = now
        self._base, self.lag = float("inf"), 0.0

    def _take_looked(self, now: float) -> None:
        """Find out how late it tells: frames that waited for a line come later than they usually do.

        They can be late by no more than the time for which nothing was heard, so what is later is a clock that was
        set, and by how much two clocks differ says nothing.
        """
        waited = now - self._looked_at
        offset, self._looked = now - self._looked, 0.0
        self._base = max(min(self._base + _DRIFT * waited, offset), offset - self.lag - waited - _SLACK_S)
        self.lag = offset - self._base
        self._looked_at = now


class Voices:
    """All observers that were heard of."""

    def __init__(self, now: float) -> None:
        """Begin without any."""
        self._voices: dict[str, Voice] = {}
        self._now = now

    def of(self, name: str, now: float) -> Voice:
        """Return an observer, a new one if need be."""
        voice = self._voices.get(name)
        if voice is None:
            voice = self._voices[name] = Voice(name, now)
        return voice

    def settle(self, now: float) -> list[Voice]:
        """Bring all to ``now``; return those that fell silent, or speak again."""
        away = now - self._now - LEAST_PATIENCE_S / 2
        self._now = now
        if away > 0:
            # Who was stopped itself has heard nothing of anybody.
            for voice in self._voices.values():
                voice.forgive(away)
        return [voice for voice in self._voices.values() if voice.settle(now)]

    def shift(self, now: float) -> None:
        """Begin anew, because the time of the monitor itself broke."""
        self._now = now
        for voice in self._voices.values():
            voice.shift(now)

    def silent(self) -> list[Voice]:
        """Return those of which nothing is heard, by name."""
        return sorted((voice for voice in self._voices.values() if voice.silent), key=lambda one: one.name)
