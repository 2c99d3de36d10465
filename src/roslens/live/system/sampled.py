"""A host, process or node: the signals that were sampled of it."""

from __future__ import annotations

import math
from collections import deque

from roslens.live.standing.measured import Measured
from roslens.live.standing.verdict_state import NEVER
from roslens.live.window.observer_status import ObserverStatus
from roslens.live.window.traffic import percentile as percentile_of
from roslens.model.entity import EntityId
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Observer

MAX_KEPT = 600
"""Samples of a signal; beyond, every second one is dropped."""
_STALE_S = 5.0


class Sampled(Measured):
    """The samples of an entity over the longest window that a constraint asks for.

    Attributes:
        host: on which it is.
        observer: who sampled it last.
        noticed: when the monitor noticed the newest sample.
        known: whether the graph has it.
        observer_status: of the observer that samples it; None if its presence cannot be determined.
    """

    __slots__ = (
        "_newest",
        "_news",
        "_spacing",
        "_values",
        "_window",
        "host",
        "known",
        "noticed",
        "observer",
        "observer_status",
    )

    def __init__(self, entity: EntityId, now: float) -> None:
        super().__init__(entity, now)
        self.host = ""
        self.observer: Observer | None = None
        self.noticed = -NEVER
        self.known = False
        self.observer_status: ObserverStatus | None = None
        self._newest = -NEVER
        self._spacing = 0.0
        self._news = False
        self._window = 0.0
        self._values: dict[str, deque[tuple[float, float]]] = {}

    def keep(self, window: float) -> None:
        """Keep samples for so many seconds; 0 keeps the newest alone."""
        self._window = window

    def add(self, sample: Sample, values: dict[str, float]) -> bool:
        """Take the ``values`` of a sample that are fine; an old or repeated sample adds nothing."""
        if sample.time <= self._newest:
            return False
        if self.seen and math.isfinite(self._newest):
            self._spacing = min(max(sample.time - self._newest, 0.9 * self._spacing), 60.0)
        self._newest = sample.time
        self._news = self.seen = True
        self.observer = sample.observer
        for key, value in values.items():
            kept = self._values.setdefault(key, deque())
            kept.append((sample.time, value))
            self._trim(kept)
        return True

    def settle(self, now: float) -> None:
        """Bring it to ``now``."""
        if self._news:
            self._news = False
            self.noticed = now

    def resume(self, time: float) -> None:
        """Be judged again: what is sampled does not depend on the clock of messages."""
        self.due = time

    def clear(self, now: float) -> None:
        """Forget all samples, because time broke."""
        self.appeared = now
        self._newest, self._spacing = -NEVER, 0.0
        self._values.clear()

    @property
    def stamp(self) -> float:
        """When the newest sample was taken, on the clock of its observer."""
        return self._newest

    @property
    def patience(self) -> float:
        """Seconds without a sample after which nothing is known any more."""
        return max(_STALE_S, 3 * self._spacing)

    def fresh(self, now: float) -> bool:
        """Whether a sample came lately."""
        return now - self.noticed <= self.patience

    @property
    def silent_observer(self) -> ObserverStatus | None:
        """The observer of it, if it is silent."""
        return self.observer_status if self.observer_status is not None and self.observer_status.silent else None

    def missed(self, now: float) -> bool:
        """Whether no sample came for long, although its observer reported all the time."""
        if self.fresh(now):
            return False
        return self.observer_status is None or (
            not self.observer_status.silent and now - self.observer_status.since > self.patience
        )

    def value(self, key: str, window: float, percentile: float, now: float) -> float | None:
        """Return the newest value, or the mean or a percentile of those in a window; None where nothing fresh is."""
        kept = self._values.get(key)
        if not kept or not self.fresh(now) or kept[-1][0] < self._newest - self.patience:
            return None
        if not window and not percentile:
            return kept[-1][1]
        values = [value for time, value in kept if time > self._newest - (window or self._window)]
        if not values:
            # A process that was started again is sampled before its load is known.
            return None
        return percentile_of(values, percentile) if percentile else sum(values) / len(values)

    def newest(self, key: str) -> float | None:
        """Return the newest value of a signal, however old."""
        kept = self._values.get(key)
        return kept[-1][1] if kept else None

    def latest(self, now: float) -> dict[str, float]:
        """Return the newest value of each signal."""
        if not self.fresh(now):
            return {}
        return {key: kept[-1][1] for key, kept in sorted(self._values.items()) if kept}

    def next_due(self, now: float) -> float:
        """Return when nothing will be known any more if nothing comes."""
        stale = self.noticed + self.patience
        if (
            now > stale
            and self.observer_status is not None
            and not self.observer_status.silent
            and not self.missed(now)
        ):
            stale = self.observer_status.since + self.patience
        return stale + 1e-9 if now <= stale else NEVER

    def _trim(self, kept: deque[tuple[float, float]]) -> None:
        oldest = kept[-1][0] - self._window
        while len(kept) > 1 and kept[0][0] <= oldest:
            kept.popleft()
        if len(kept) > MAX_KEPT:
            thinned = list(kept)[::2]
            if thinned[-1] != kept[-1]:
                thinned.append(kept[-1])
            kept.clear()
            kept.extend(thinned)


def finite(values: dict[str, float]) -> dict[str, float]:
    """Return the values that are finite numbers."""
    return {key: value for key, value in values.items() if value - value == 0}
