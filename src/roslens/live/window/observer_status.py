"""The status of observers as the monitor sees it: up to when each has looked, and whether it is silent.

A connection without reports was silent only if its observer states that it has looked; an observer that does not report
may be stopped or disconnected, while everything it observes continues.
"""

from __future__ import annotations

LEAST_PATIENCE_S = 1.5
"""An observer that has reported within this time is not silent."""
_TURNS = 3
"""An observer that has missed so many of its turns is silent."""
_SLACK_S = 0.2
_DRIFT = 0.001
"""Clocks drift apart by less than this."""


class ObserverStatus:
    """One observer; times are on the monitor's clock, but for ``looked``.

    Attributes:
        name: of the observer: ``<host>/<kind of observer>``.
        of_graph: whether it reports the graph.
        last_received: when its last report was received.
        lag: seconds by which its last report was later than usual, because it waited for a connection.
        silent: whether it has not reported for longer than usual.
        since: when it became silent, or began to report.
    """

    __slots__ = (
        "_base", "_fresh", "_looked", "_looked_at", "_spacing", "lag", "last_received", "name", "of_graph", "silent",
        "since",
    )  # fmt: skip

    def __init__(self, name: str, now: float) -> None:
        """Begin at ``now``."""
        self.name = name
        self.of_graph = False
        self.last_received = self.since = self._looked_at = now
        self.silent = False
        self._fresh = False
        self._looked = 0.0
        self._base = float("inf")
        self.lag = 0.0
        self._spacing = 0.0

    def take_report(self, looked: float) -> None:
        """Note that it reported, and up to when it has looked on its own clock; 0 if it did not state this."""
        self._fresh = True
        if looked:
            self._looked = looked

    def settle(self, now: float) -> bool:
        """Bring it to ``now``; return whether it fell silent, or reports again."""
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
        """Seconds without a report after which the observer is silent."""
        return max(LEAST_PATIENCE_S, _TURNS * self._spacing)

    def behind(self, now: float) -> float:
        """Return the seconds up to ``now`` of which it has not reported what it saw."""
        return max(now - self._looked_at, 0.0) + self.lag

    def forgive(self, seconds: float) -> None:
        """Do not count a time in which the monitor itself was stopped."""
        self.last_received += seconds

    def shift(self, now: float) -> None:
        """Begin anew, because the time of the monitor itself broke."""
        self.last_received = self._looked_at = now
        self._base, self.lag = float("inf"), 0.0

    def _take_looked(self, now: float) -> None:
        """Estimate how late it reports: frames that waited for a connection come later than usual.

        They can be late by no more than the time without a report, so what is later is a clock that was
        set, and by how much two clocks differ says nothing.
        """
        waited = now - self._looked_at
        offset, self._looked = now - self._looked, 0.0
        self._base = max(min(self._base + _DRIFT * waited, offset), offset - self.lag - waited - _SLACK_S)
        self.lag = offset - self._base
        self._looked_at = now


class ObserverStatuses:
    """All observers that have reported."""

    def __init__(self, now: float) -> None:
        """Begin without any."""
        self._statuses: dict[str, ObserverStatus] = {}
        self._now = now

    def of(self, name: str, now: float) -> ObserverStatus:
        """Return an observer, a new one if need be."""
        observer_status = self._statuses.get(name)
        if observer_status is None:
            observer_status = self._statuses[name] = ObserverStatus(name, now)
        return observer_status

    def settle(self, now: float) -> list[ObserverStatus]:
        """Bring all to ``now``; return those that fell silent, or report again."""
        away = now - self._now - LEAST_PATIENCE_S / 2
        self._now = now
        if away > 0:
            # While the monitor was stopped, it received no reports.
            for observer_status in self._statuses.values():
                observer_status.forgive(away)
        return [observer_status for observer_status in self._statuses.values() if observer_status.settle(now)]

    def shift(self, now: float) -> None:
        """Begin anew, because the time of the monitor itself broke."""
        self._now = now
        for observer_status in self._statuses.values():
            observer_status.shift(now)

    def silent(self) -> list[ObserverStatus]:
        """Return the silent ones, by name."""
        return sorted(
            (observer_status for observer_status in self._statuses.values() if observer_status.silent),
            key=lambda one: one.name,
        )
