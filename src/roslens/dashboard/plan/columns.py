"""In which column each part stands: nodes by the way most things flow, what joins them between."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from roslens.dashboard.plan.flow import Flow, tiers
from roslens.dashboard.plan.ground import Part, Wire

MOST_PAIRS = 600
"""A topic that joins more pairs of nodes does not affect their placement."""

_ASPECT = 1.7


def through(parts: Sequence[Part], wires: Iterable[Wire]) -> dict[Flow, list[int]]:
    """Return what flows from node to node, both as numbers of parts, with the numbers of what it flows through."""
    number = {part.key: place for place, part in enumerate(parts)}
    giving, taking = ends_of(parts, number, wires)
    found: dict[Flow, list[int]] = {}
    for channel, sources in sorted(giving.items()):
        for source in sources:
            for target in taking.get(channel, ()):
                found.setdefault((source, target), []).append(channel)
    return found


def ends_of(
    parts: Sequence[Part], number: Mapping[str, int], wires: Iterable[Wire]
) -> tuple[dict[int, list[int]], dict[int, list[int]]]:
    """Return for what joins nodes which of them give to it, and which take from it."""
    giving: dict[int, list[int]] = {}
    taking: dict[int, list[int]] = {}
    for start, end in wires:
        source, target = number[start], number[end]
        if parts[source].node and parts[target].node:
            continue
        if parts[source].node:
            giving.setdefault(target, []).append(source)
        else:
            taking.setdefault(source, []).append(target)
    return giving, taking


def tiers_of(parts: Sequence[Part], wires: Sequence[Wire]) -> dict[int, int]:
    """Return the tier of each node, by the number of its part; what has nothing to do with others fills up."""
    number = {part.key: place for place, part in enumerate(parts)}
    return _tiers(parts, number, wires, *ends_of(parts, number, wires))


def _tiers(
    parts: Sequence[Part],
    number: Mapping[str, int],
    wires: Sequence[Wire],
    giving: Mapping[int, Sequence[int]],
    taking: Mapping[int, Sequence[int]],
) -> dict[int, int]:
    nodes = [place for place, part in enumerate(parts) if part.node]
    place_of = {node: place for place, node in enumerate(nodes)}
    direct = [pair for start, end in wires if (pair := (number[start], number[end])) if _joined(parts, pair)]
    flows: dict[Flow, int] = {(place_of[source], place_of[target]): 1 for source, target in direct}
    for channel, sources in sorted(giving.items()):
        targets = taking.get(channel, ())
        if parts[channel].quiet or len(sources) * len(targets) > MOST_PAIRS:
            continue
        for source in sources:
            for target in targets:
                if source != target:
                    pair = (place_of[source], place_of[target])
                    flows[pair] = flows.get(pair, 0) + 1
    shown = sum(not part.quiet for part in parts) + len(direct)
    found = tiers(len(nodes), flows, max(3, round((shown / 4) ** 0.5 * _ASPECT / 2)))
    linked = {end for pair in flows for end in pair}
    wide = 1 + max((found[node] for node in linked), default=0)
    for place, node in enumerate(node for node in range(len(nodes)) if node not in linked):
        found[node] = place % wide
    return {node: found[place] for place, node in enumerate(nodes)}


def _joined(parts: Sequence[Part], pair: Flow) -> bool:
    """Whether a wire leads from one node right to another, as where topics are drawn as lines."""
    return pair[0] != pair[1] and parts[pair[0]].node and parts[pair[1]].node


def columns_of(parts: Sequence[Part], wires: Sequence[Wire]) -> list[int]:
    """Return columns: what joins nodes stands right behind who gives it, or before the first that takes it."""
    number = {part.key: place for place, part in enumerate(parts)}
    giving, taking = ends_of(parts, number, wires)
    tier = _tiers(parts, number, wires, giving, taking)
    found = []
    for place in range(len(parts)):
        if place in tier:
            found.append(2 * tier[place] + 1)
        elif place in giving:
            latest = max((tier[node] for node in taking.get(place, ())), default=None)
            given = [tier[node] for node in giving[place]]
            before = [one for one in given if latest is None or one < latest]
            found.append(2 * max(before or given) + 2)
        else:
            found.append(2 * min((tier[node] for node in taking.get(place, ())), default=0))
    return closed_up(found)


def closed_up(columns: Sequence[int]) -> list[int]:
    """Return the same columns without empty ones between."""
    used = {column: place for place, column in enumerate(sorted(set(columns)))}
    return [used[column] for column in columns]
