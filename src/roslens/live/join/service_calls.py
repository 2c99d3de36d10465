"""Service calls, joined from the reports of several hosts: a server on one, clients on others."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.live.window.newest import MOST_GONE
from roslens.model.entity import EntityId
from roslens.model.traffic.sample import Sample

EVERY_S = 1.0
STALE_S = 2.5
"""After which what a host reported is no longer counted."""
_TIMED_BY = {"response_time": "calls", "client_response_time": "client_calls"}


class ServiceCalls:
    """The latest that each observer reported of each service; instants are on the monitor's clock."""

    def __init__(self) -> None:
        self._reported: dict[EntityId, dict[str, tuple[float, Sample]]] = {}
        self._news: set[EntityId] = set()
        self._due = float("-inf")

    def put(self, sender: str, sample: Sample, now: float) -> None:
        """Take the report of an observer on a service."""
        self._reported.setdefault(sample.entity, {})[sender] = (now, sample)
        self._news.add(sample.entity)

    def samples(self, now: float) -> list[Sample]:
        """Return a sample of each service of which there is news, once a second."""
        if not self._news or 0 <= now - (self._due - EVERY_S) < EVERY_S:
            return []
        self._due = now + EVERY_S
        found = []
        for service in sorted(self._news):
            reported = self._reported[service]
            for sender in [sender for sender, (last_report, _) in reported.items() if now - last_report > STALE_S]:
                del reported[sender]
            latest = [sample for _, sample in reported.values()]
            if latest:
                found.append(Sample(service, now, _joined([one.values for one in latest]), latest[0].observer))
        self._news.clear()
        if len(self._reported) > MOST_GONE:
            self._reported = {
                service: reported
                for service, reported in self._reported.items()
                if any(now - last_report <= STALE_S for last_report, _ in reported.values())
            }
        return found


def _joined(parts: list[Mapping[str, float]]) -> dict[str, float]:
    """Return the values of all: calls add up, times are weighed by calls, of the longest the longest."""
    values: dict[str, float] = {}
    for key in ("calls", "client_calls"):
        known = [part[key] for part in parts if key in part]
        if known:
            values[key] = sum(known)
    for key, calls in _TIMED_BY.items():
        timed = [(part[key], max(part.get(calls, 0.0), 1e-9)) for part in parts if key in part]
        if timed:
            values[key] = sum(time * weight for time, weight in timed) / sum(weight for _, weight in timed)
        longest = [part[f"{key}_max"] for part in parts if f"{key}_max" in part]
        if longest:
            values[f"{key}_max"] = max(longest)
    return values
