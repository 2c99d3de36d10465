"""The way from a fault to its first cause, link by link, each with what shows it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from itertools import pairwise

from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import Link

MOST_VISITED = 2_000
"""Entities that are looked at for one way; of a larger graph the ends are told alone."""

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
    fault: EntityId,
    cause: EntityId,
    upstream: Callable[[EntityId], Iterable[EntityId]],
    evidence: Callable[[EntityId, EntityId], str],
) -> tuple[Link, ...]:
    """Return the shortest way from a fault to its cause.

    Args:
        fault: that is explained.
        cause: that explains it.
        upstream: what an entity depends on, as far as that may explain what is wrong with it.
        evidence: what is wrong with the second entity, as far as the first is concerned; empty for nothing.
    """
    came: dict[EntityId, EntityId] = {}
    waiting = deque([fault])
    while waiting and cause not in came and len(came) < MOST_VISITED:
        entity = waiting.popleft()
        for one in sorted(upstream(entity)):
            if one not in came and one != fault:
                came[one] = entity
                waiting.append(one)
    if cause not in came:
        return (Link(str(cause), "is explained by", evidence(fault, cause)),)
    way = [cause]
    while way[-1] != fault:
        way.append(came[way[-1]])
    way.reverse()
    return tuple(
        Link(str(after), _RELATIONS.get((before.kind, after.kind), "depends on"), evidence(before, after))
        for before, after in pairwise(way)
    )


def links_text(entity: EntityId | str, way: Iterable[Link]) -> str:
    """Return ``topic:/map is published by node:/slam, which runs on host:r1 (is gone)``."""
    text = str(entity)
    for number, link in enumerate(way):
        shows = f" ({link.evidence})" if link.evidence else ""
        text += f"{', which' if number else ''} {link.relation} {link.entity}{shows}"
    return text
