"""In which column each node stands, so that most things flow from left to right."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

Flow = tuple[int, int]


def ordered(count: int, flows: Mapping[Flow, int]) -> list[int]:
    """Return the nodes in an order against which little flows.

    The greedy heuristic of Eades, Lin and Smyth (1993): sinks to the end, sources to the front, then what gives more
    than it takes by most.

    Args:
        count: nodes are numbers below it; lower ones come first where nothing else decides.
        flows: how much flows from one node to another.
    """
    given = [0] * count
    taken = [0] * count
    beside: list[list[tuple[int, int, bool]]] = [[] for _ in range(count)]
    for (source, target), amount in sorted(flows.items()):
        if source != target:
            given[source] += amount
            taken[target] += amount
            beside[source].append((target, amount, True))
            beside[target].append((source, amount, False))
    left = set(range(count))
    front: list[int] = []
    back: list[int] = []

    def take(node: int, side: list[int]) -> None:
        left.discard(node)
        side.append(node)
        for other, amount, outward in beside[node]:
            if outward:
                taken[other] -= amount
            else:
                given[other] -= amount

    while left:
        sources = sorted(node for node in left if not taken[node])
        if sources:
            take(sources[0], front)
            continue
        sinks = sorted(node for node in left if not given[node])
        if sinks:
            take(sinks[-1], back)
            continue
        take(max(sorted(left), key=lambda node: given[node] - taken[node]), front)
    return [*front, *reversed(back)]


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
