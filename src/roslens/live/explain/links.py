"""The ways from faults to their first causes, link by link, each with what shows it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from itertools import pairwise

from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import Link

MOST_VISITED = 50_000
"""Entities that are looked at for all ways together; of a larger graph both ends alone are reported."""

_RELATIONS = {
    (EntityKind.TOPIC, EntityKind.NODE): "is published by",
    (EntityKind.CONNECTION, EntityKind.TOPIC): "is over",
    (EntityKind.CONNECTION, EntityKind.NODE): "is between",
    (EntityKind.NODE, EntityKind.TOPIC): "subscribes to",
    (EntityKind.NODE, EntityKind.HOST): "runs on",
    (EntityKind.PROCESS, EntityKind.HOST): "runs on",
    (EntityKind.SERVICE, EntityKind.NODE): "is served by",
    (EntityKind.ACTION, EntityKind.NODE): "is served by",
}


def links(
    causes: Mapping[EntityId, EntityId],
    upstream: Callable[[EntityId], Iterable[EntityId]],
    evidence: Callable[[EntityId, EntityId], str],
) -> dict[EntityId, tuple[Link, ...]]:
    """Return the shortest way from each fault to its cause; of several the one whose steps sort first.

    What many faults have in common is looked at once: where everything breaks at once, each of them would otherwise
    search the whole graph.

    Args:
        causes: of each fault what explains it.
        upstream: what an entity depends on, as far as that may explain what is wrong with it; asked once for each.
        evidence: what is wrong with the second entity, as far as the first is concerned; empty for nothing. Asked
            once for each pair.
    """
    nearer, further = _graph(causes, upstream)
    faults: dict[EntityId, list[EntityId]] = {}
    for fault, cause in causes.items():
        faults.setdefault(cause, []).append(fault)
    known: dict[tuple[EntityId, EntityId], Link] = {}

    def link(before: EntityId, after: EntityId, relation: str) -> Link:
        if (before, after) not in known:
            known[before, after] = Link(str(after), relation, evidence(before, after))
        return known[before, after]

    found: dict[EntityId, tuple[Link, ...]] = {}
    for cause, explained in faults.items():
        distances = _distances(cause, further, explained)
        for fault in explained:
            if fault not in distances or fault == cause:
                found[fault] = (Link(str(cause), "is explained by", evidence(fault, cause)),)
                continue
            way = [fault, *_steps(fault, nearer, distances)]
            found[fault] = tuple(
                link(before, after, _RELATIONS.get((before.kind, after.kind), "depends on"))
                for before, after in pairwise(way)
            )
    return found


_Ends = dict[EntityId, list[EntityId]]


def _graph(faults: Iterable[EntityId], upstream: Callable[[EntityId], Iterable[EntityId]]) -> tuple[_Ends, _Ends]:
    """Return what each entity that can be reached depends on, in order, and what depends on each."""
    nearer: _Ends = {}
    further: _Ends = {}
    waiting = deque(faults)
    while waiting and len(nearer) < MOST_VISITED:
        entity = waiting.popleft()
        if entity in nearer:
            continue
        nearer[entity] = sorted(upstream(entity))
        for one in nearer[entity]:
            further.setdefault(one, []).append(entity)
            waiting.append(one)
    return nearer, further


def _distances(cause: EntityId, further: _Ends, faults: Collection[EntityId]) -> dict[EntityId, int]:
    """Return how many steps there are to the cause, of all that is no further than the furthest of the faults."""
    distances, missing = {cause: 0}, set(faults) - {cause}
    waiting = deque([cause])
    while waiting and missing:
        entity = waiting.popleft()
        for one in further.get(entity, ()):
            if one not in distances:
                distances[one] = distances[entity] + 1
                missing.discard(one)
                waiting.append(one)
    return distances


def _steps(fault: EntityId, nearer: _Ends, distances: Mapping[EntityId, int]) -> Iterator[EntityId]:
    """Yield what lies between a fault and its cause, and the cause."""
    at = fault
    for distance in range(distances[fault] - 1, -1, -1):
        at = next(one for one in nearer[at] if distances.get(one) == distance)
        yield at


def links_text(entity: EntityId | str, way: Iterable[Link]) -> str:
    """Return ``topic:/map is published by node:/slam, which runs on host:r1 (is gone)``."""
    text = str(entity)
    for number, link in enumerate(way):
        shows = f" ({link.evidence})" if link.evidence else ""
        text += f"{', which' if number else ''} {link.relation} {link.entity}{shows}"
    return text
