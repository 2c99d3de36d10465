"""In which column each node stands, so that most things flow from left to right."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from heapq import heapify, heappop, heappush

Flow = tuple[int, int]


def ordered(count: int, flows: Mapping[Flow, int]) -> list[int]:
    """Return the nodes in an order against which little flows.

    The greedy heuristic of Eades, Lin and Smyth (1993): sinks to the end, sources to the front, then what gives more
    than it takes by most.

    Args:
        count: nodes are numbers below it; lower ones come first where nothing else decides.
        flows: how much flows from one node to another.
    """
    queue = _Queue(count, flows)
    front: list[int] = []
    back: list[int] = []
    while len(front) + len(back) < count:
        if (source := queue.source()) is not None:
            front.append(source)
        elif (sink := queue.sink()) is not None:
            back.append(sink)
        else:
            front.append(queue.giver())
    return [*front, *reversed(back)]


class _Queue:
    """Nodes that have no place yet, by how much they give to each other and take."""

    def __init__(self, count: int, flows: Mapping[Flow, int]) -> None:
        self._given = [0] * count
        self._taken = [0] * count
        self._beside: list[list[tuple[int, int, bool]]] = [[] for _ in range(count)]
        for (source, target), amount in sorted(flows.items()):
            if source != target:
                self._given[source] += amount
                self._taken[target] += amount
                self._beside[source].append((target, amount, True))
                self._beside[target].append((source, amount, False))
        self._placed = [False] * count
        self._sources = [node for node in range(count) if not self._taken[node]]
        self._sinks = [-node for node in reversed(range(count)) if not self._given[node]]
        self._givers = [(self._taken[node] - self._given[node], node) for node in range(count)]
        heapify(self._givers)

    def source(self) -> int | None:
        """Return the first that takes nothing; None where all do."""
        return self._first(self._sources)

    def sink(self) -> int | None:
        """Return the last that gives nothing; None where all do."""
        return self._first(self._sinks)

    def giver(self) -> int:
        """Return the first of those that give more than they take by most."""
        while True:
            less, node = heappop(self._givers)
            # What has changed since stands in the heap once more.
            if not self._placed[node] and less == self._taken[node] - self._given[node]:
                return self._placing(node)

    def _first(self, heap: list[int]) -> int | None:
        while heap:
            node = abs(heappop(heap))
            if not self._placed[node]:
                return self._placing(node)
        return None

    def _placing(self, node: int) -> int:
        self._placed[node] = True
        for other, amount, outward in self._beside[node]:
            if outward:
                self._taken[other] -= amount
                if not self._taken[other]:
                    heappush(self._sources, other)
            else:
                self._given[other] -= amount
                if not self._given[other]:
                    heappush(self._sinks, -other)
            heappush(self._givers, (self._taken[other] - self._given[other], other))
        return node


def tiers(count: int, flows: Mapping[Flow, int], most: int) -> list[int]:
    """Return the tier of each node, from 0, at most ``most`` of them; what flows against the order decides nothing.

    A node that takes from nobody stands right before the first that takes from it.
    """
    place = {node: number for number, node in enumerate(ordered(count, flows))}
    forward = sorted(flow for flow in flows if place[flow[0]] < place[flow[1]])
    forward.sort(key=lambda flow: place[flow[0]])
    found = [0] * count
    for source, target in forward:
        found[target] = max(found[target], found[source] + 1)
    fed = {target for _, target in forward}
    first: dict[int, int] = {}
    for source, target in forward:
        first[source] = min(first.get(source, found[target]), found[target])
    found = [first[node] - 1 if node in first and node not in fed else tier for node, tier in enumerate(found)]
    return _narrowed(found, most)


def _narrowed(found: Sequence[int], most: int) -> list[int]:
    used = sorted(set(found))
    number = {tier: place for place, tier in enumerate(used)}
    return [number[tier] * most // max(most, len(used)) for tier in found]
