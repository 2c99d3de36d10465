"""Calls of services as samples: how many a second and how long they took, for servers and for clients.

A server is asked and replies; a client requests and hears. Times of calls are known where both ends of a call were
counted in one process, so a call that is never answered has none.
"""

from __future__ import annotations

from collections.abc import Iterable

from roslens.live.inside import slots
from roslens.live.inside.counters import Called
from roslens.model.entity import EntityId, EntityKind
from roslens.model.sample import Sample
from roslens.model.tally import NOTHING, Moments, Observer

_COUNTED = {slots.ASKED: "calls", slots.REQUESTED: "client_calls"}
_TIMED = {slots.REPLIED: "response_time", slots.HEARD: "client_response_time"}


class CallTimes:
    """What was counted of each service since samples were made of it."""

    def __init__(self) -> None:
        self._counts: dict[str, dict[str, int]] = {}
        self._times: dict[str, dict[str, Moments]] = {}
        self._since: float | None = None

    def add(self, called: Iterable[Called]) -> None:
        """Take what a reader tells."""
        for one in called:
            service = one.tally.topic
            counts, times = self._counts.setdefault(service, {}), self._times.setdefault(service, {})
            if key := _COUNTED.get(one.kind):
                counts[key] = counts.get(key, 0) + one.tally.count
            elif key := _TIMED.get(one.kind):
                times[key] = times.get(key, NOTHING).merged(one.tally.processing)

    def samples(self, now: float) -> list[Sample]:
        """Return a sample of each service that ever was called, and begin anew; ``now`` is seconds since the epoch."""
        passed = now - self._since if self._since is not None else 0.0
        self._since = now
        samples = []
        for service in sorted(self._counts):
            counts, times = self._counts[service], self._times[service]
            values = {key: count / passed for key, count in counts.items()} if passed > 0 else {}
            for key, moments in times.items():
                if moments.mean is not None:
                    values[key], values[f"{key}_max"] = moments.mean, moments.greatest
            self._counts[service] = dict.fromkeys(counts, 0)
            self._times[service] = {}
            if values:
                samples.append(Sample(EntityId(EntityKind.SERVICE, service), now, values, Observer.INSIDE))
        return samples
