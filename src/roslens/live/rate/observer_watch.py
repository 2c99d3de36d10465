"""The observers of a monitor, and what is evaluated again when one falls silent or reports again."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from roslens.judge.reference.expectation import Presence
from roslens.live.rate.evaluator import Evaluator
from roslens.live.standing.measured import Measured
from roslens.live.standing.silent_observer import Silence, waits_for
from roslens.live.standing.standing import Standing
from roslens.live.system.connection import Connection
from roslens.live.system.sampled import Sampled
from roslens.live.system.world import World
from roslens.live.window.observer_status import ObserverStatus, ObserverStatuses


class ObserverWatch:
    """The observers of a monitor, and the silence of each as a verdict about it."""

    def __init__(self, world: World, evaluator: Evaluator, start: float) -> None:
        """Begin at ``start`` without any."""
        self._world = world
        self._evaluator = evaluator
        self._statuses = ObserverStatuses(start)
        self._silences: dict[str, Silence] = {}

    def take_report(self, sender: str, looked: float, now: float, *, of_graph: bool) -> ObserverStatus:
        """Note that an observer reported, up to when it has looked, and whether it reports the graph."""
        observer_status = self._statuses.of(sender, now)
        observer_status.take_report(looked)
        observer_status.of_graph = observer_status.of_graph or of_graph
        return observer_status

    def settle(self, now: float) -> list[Standing]:
        """Find out which observers are silent; return those of which that changed."""
        turned = self._statuses.settle(now)
        if not turned:
            return []
        self._evaluator.silent = self._statuses.silent()
        reported: list[Standing] = []
        for observer_status in turned:
            silence = self._silences.get(observer_status.name) or self._silences.setdefault(
                observer_status.name, Silence(observer_status, now)
            )
            silence.follow(now)
            reported.append(silence)
            for one in self._observed(observer_status):
                self._evaluator.wait(one)
        return reported

    def standing(self) -> Iterator[Standing]:
        """Yield the silent observers."""
        return (one for one in self._silences.values() if one.observer_status.silent)

    def waits_for(self, presence: Presence) -> ObserverStatus | None:
        """Return the silent observer that would report whether something is there."""
        return waits_for(presence, self._evaluator.silent) if self._evaluator.silent else None

    def silent_of_graph(self) -> ObserverStatus | None:
        """Return a silent observer that reports nodes and their states."""
        return next((observer_status for observer_status in self._evaluator.silent if observer_status.of_graph), None)

    def shift(self, now: float) -> None:
        """Begin anew, because the time of the monitor itself broke."""
        self._statuses.shift(now)

    def _observed(self, observer_status: ObserverStatus) -> Iterator[Measured]:
        for one in chain(self._world.connections.values(), self._world.sampled.values()):
            if isinstance(one, Connection) and one.reported_by(observer_status):
                one.wake()
                yield one
            elif isinstance(one, Sampled) and one.observer_status is observer_status:
                yield one
        if observer_status.of_graph:
            yield from self._world.topics.values()
