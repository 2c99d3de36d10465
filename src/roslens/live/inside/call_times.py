"""Calls of services as samples: how many a second and how long they took, for servers and for clients.

A server is asked and replies; a client requests and hears. Times of calls are known where both ends of a call were
counted in one process, so a call that is never answered has none.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from itertools import pairwise

from roslens.live.inside import slots
from roslens.live.inside.counters import Called
from roslens.model.entity import EntityId, EntityKind
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import NOTHING, Moments, Observer

_COUNTED = {slots.ASKED: "calls", slots.REQUESTED: "client_calls"}
_TIMED = {slots.REPLIED: "response_time", slots.HEARD: "client_response_time"}

SHORTEST_S = 1.0
LONGEST_S = 60.0
"""A rate is that of so long at least, and at most of so long."""
ENOUGH = 4
"""So many times between calls make a rate, where they are not more than the longest apart."""
MOST_SERVICES = 10_000
"""Further ones are not reported: names come from files that others may write."""


class CallRate:
    """How many calls a second came, over several of their own periods: who is called every 2 s is called at 0.5 Hz."""

    def __init__(self) -> None:
        self._read: deque[tuple[float, int]] = deque()
        self._calls = 0

    def add(self, last: float, count: int) -> None:
        """Take what a read found: so many calls, the last of them at ``last``."""
        self._calls += count
        if self._read and last <= self._read[-1][0]:
            last, known = self._read.pop()
            count += known
        self._read.append((last, count))

    def at(self, now: float) -> float | None:
        """Return calls per second at ``now``; None if there are too few."""
        read = self._read
        if read and now < read[-1][0] - SHORTEST_S:  # the clock was set back
            read.clear()
            self._calls = 0
        while len(read) > 1 and self._enough_without_first(now):
            self._calls -= read.popleft()[1]
        if not read:
            return None
        first, last = read[0][0], read[-1][0]
        quiet = max(now - last, 0.0)
        if len(read) == 1:
            return None if quiet < SHORTEST_S else 1 / quiet if quiet < LONGEST_S else 0.0
        times = [when for when, _ in read]
        longest = max(later - earlier for earlier, later in pairwise(times))
        if quiet >= min(max(last - first, SHORTEST_S), LONGEST_S):
            return 0.0
        return (self._calls - read[0][1]) / (last - first + max(quiet - longest, 0.0))

    def _enough_without_first(self, now: float) -> bool:
        (first, count), (second, of_second) = self._read[0], self._read[1]
        intervals = self._calls - count - of_second
        return now - first > LONGEST_S or (self._read[-1][0] - second >= SHORTEST_S and intervals >= ENOUGH)


class CallTimes:
    """What was counted of each service since samples were made of it."""

    def __init__(self) -> None:
        self._rates: dict[str, dict[str, CallRate]] = {}
        self._times: dict[str, dict[str, Moments]] = {}

    def add(self, called: Iterable[Called]) -> None:
        """Take the counts of a reader."""
        for one in called:
            service, tally = one.tally.topic, one.tally
            if service not in self._rates and len(self._rates) >= MOST_SERVICES:
                continue
            rates, times = self._rates.setdefault(service, {}), self._times.setdefault(service, {})
            if key := _COUNTED.get(one.kind):
                rate = rates.setdefault(key, CallRate())
                if tally.count:
                    rate.add(tally.last, tally.count)
            elif key := _TIMED.get(one.kind):
                times[key] = times.get(key, NOTHING).merged(tally.processing)

    def samples(self, now: float) -> list[Sample]:
        """Return a sample of each service that ever was called; ``now`` is seconds since the epoch."""
        samples = []
        for service in sorted(self._rates):
            rates, times = self._rates[service], self._times[service]
            values = {key: value for key, rate in rates.items() if (value := rate.at(now)) is not None}
            for key, moments in times.items():
                if moments.mean is not None:
                    values[key], values[f"{key}_max"] = moments.mean, moments.greatest
            self._times[service] = {}
            if values:
                samples.append(Sample(EntityId(EntityKind.SERVICE, service), now, values, Observer.INSIDE))
        return samples
