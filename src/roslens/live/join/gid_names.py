"""The names of publishers of which an observer without ROS knows the identifiers alone.

Such an observer may hear of a publisher before the graph does, so what it tells waits a moment for the name; and of one
that is gone from the graph its last messages are counted afterwards, so names are kept for a while. What a node counts
that is in no graph is of another domain, and reported to nobody.
"""

from __future__ import annotations

from collections import deque

import msgspec

from roslens.model.graph import Graph
from roslens.model.traffic.tally import BY_GID, Tally

WAIT_S = 5.0
"""How long a tally waits for the name of its publisher."""
KEPT_S = 60.0
MOST_WAITING = 10_000
_OF_ACTION = "/_action/"


class GidNames:
    """Names publishers by the graph."""

    def __init__(self) -> None:
        self._names: dict[str, str] = {}
        self._left: dict[str, tuple[str, float]] = {}
        self._there: set[tuple[str, str]] = set()
        self._nodes: set[str] = set()
        self._ends: set[str] = set()
        self._waiting: deque[tuple[float, Tally]] = deque()

    def take_graph(self, graph: Graph, now: float) -> None:
        """Take the whole graph as it is at ``now``, on the monitor's clock."""
        names = {end.gid: end.node for end in graph.endpoints if end.gid}
        self._left.update((gid, (node, now)) for gid, node in self._names.items() if gid not in names)
        self._left = {gid: left for gid, left in self._left.items() if gid not in names and now - left[1] < KEPT_S}
        self._names = names
        self._there = {(end.node, end.name) for end in graph.endpoints}
        self._ends = {end.name for end in graph.endpoints}
        self._nodes = {end.node for end in graph.endpoints} | {node for node, _ in self._left.values()}

    def named(self, tally: Tally, now: float) -> Tally | None:
        """Return a tally with the name of its publisher; None of one that waits, or is silent and no connection."""
        known = self._known(tally)
        if known is None:
            if (tally.count or tally.lost > 0) and len(self._waiting) < MOST_WAITING:
                self._waiting.append((now, tally))
            return None
        return known if known.count or self._stands(known) else None

    def due(self, now: float) -> list[Tally]:
        """Return what waits no longer: with a name, or without one where none came in time."""
        found = []
        for _ in range(len(self._waiting)):
            since, tally = self._waiting.popleft()
            known = self._known(tally)
            if known is not None:
                found.append(known)
            elif 0 <= now - since < WAIT_S:
                self._waiting.append((since, tally))
            elif self._counts(tally):
                found.append(msgspec.structs.replace(tally, publisher=""))
        return found

    def has(self, service: str) -> bool:
        """Return whether the graph has a service, or the action that it is a part of.

        Without a graph of ROS 2 all may be. What the nodes of another domain call is in no graph.
        """
        return not self._names or service in self._ends or service.partition(_OF_ACTION)[0] in self._ends

    def _known(self, tally: Tally) -> Tally | None:
        """Return a tally with names; None where the graph lacks its node or the name of its publisher."""
        if not self._counts(tally):
            return None
        if not tally.publisher.startswith(BY_GID):
            return tally
        gid = tally.publisher.removeprefix(BY_GID)
        name = self._names.get(gid) or self._left.get(gid, ("", 0.0))[0]
        return msgspec.structs.replace(tally, publisher=name) if name else None

    def _counts(self, tally: Tally) -> bool:
        """Return whether the graph has the node that counted; without a graph of ROS 2 it may have any."""
        return not self._names or (tally.subscriber or tally.publisher) in self._nodes

    def _stands(self, tally: Tally) -> bool:
        """Return whether a connection still exists: the silence of a removed one is not worth reporting."""
        return all((name, tally.topic) in self._there for name in (tally.publisher, tally.subscriber) if name)
