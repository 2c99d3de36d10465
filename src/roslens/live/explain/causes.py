"""Which fault explains which: the first bad entity upstream of each bad one.

Upstream of a topic are the nodes that publish it, of a node the topics it subscribes to and its host, of a connection
its topic and publisher. A topic that is judged fine ends the search, since data flows there. In a cycle the fault that
began first is the cause. What matters more is never explained by what matters less: a warning about a host may be why
a topic is slow, but nobody who reads it would look for the error. Of several that explain a fault it is the gravest,
of these the first. Tarjan's strongly connected components make one pass enough.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from roslens.model.entity import EntityId, EntityKind

LATE_S = 2.0
"""A cause may be noticed so much later than what it causes, since windows differ."""

Upstream = Callable[[EntityId], Iterable[EntityId]]
_Roots = dict[int, EntityId]
"""By weight the first fault upstream that weighs at least as much."""


def first_causes(
    bad: Mapping[EntityId, float],
    fine: Callable[[EntityId], bool],
    upstream: Upstream,
    weights: Mapping[EntityId, int] | None = None,
    until: Mapping[EntityId, float] | None = None,
) -> dict[EntityId, EntityId]:
    """Return for each bad entity that another explains the one that does.

    Args:
        bad: since when each bad entity is so.
        fine: whether an entity is judged and fine.
        upstream: what an entity depends on.
        weights: how much each bad entity matters; all the same where nothing is said.
        until: when what an entity causes has begun at the latest; any time later where nothing is said.
    """
    causes: dict[EntityId, EntityId] = {}
    carried: dict[EntityId, _Roots] = {}
    weight_of = {entity: (weights or {}).get(entity, 0) for entity in bad}
    levels = sorted(set(weight_of.values()))

    def open_upstream(entity: EntityId) -> list[EntityId]:
        return sorted(
            one
            for one in upstream(entity)
            if one in bad or not (one.kind in (EntityKind.TOPIC, EntityKind.CONNECTION) and fine(one))
        )

    def order(entity: EntityId) -> tuple[float, EntityId]:
        return bad[entity], entity

    def explains(cause: EntityId | None, fault: EntityId) -> bool:
        latest = (until or {}).get(cause, float("inf")) if cause is not None else 0.0
        return cause is not None and bad[cause] - LATE_S <= bad[fault] <= latest

    for component, links in _components(sorted(bad), open_upstream):
        members = set(component)
        sources = [carried[one] for entity in component for one in links[entity] if one not in members]
        inside = sorted((entity for entity in component if entity in bad), key=order)
        roots: _Roots = {}
        graver: list[EntityId] = []
        for level in reversed(levels):
            outside = min((found[level] for found in sources if level in found), key=order, default=None)
            graver += [outside] if outside is not None else []
            first = next((entity for entity in inside if weight_of[entity] >= level), None)
            root = outside if first is None else next((one for one in graver if explains(one, first)), first)
            if root is not None:
                roots[level] = root
        for entity in component:
            carried[entity] = roots
        for entity in inside:
            root = roots[weight_of[entity]]
            if entity != root:
                causes[entity] = root
    return causes


def _components(
    starts: Iterable[EntityId], upstream: Callable[[EntityId], list[EntityId]]
) -> Iterable[tuple[list[EntityId], dict[EntityId, list[EntityId]]]]:
    """Yield strongly connected components, upstream ones first, without recursion."""
    links: dict[EntityId, list[EntityId]] = {}
    number: dict[EntityId, int] = {}
    low: dict[EntityId, int] = {}
    open_: list[EntityId] = []
    waiting: set[EntityId] = set()
    for start in starts:
        if start in number:
            continue
        path: list[tuple[EntityId, int]] = [(start, 0)]
        while path:
            entity, at = path.pop()
            if at == 0:
                number[entity] = low[entity] = len(number)
                links[entity] = upstream(entity)
                open_.append(entity)
                waiting.add(entity)
            else:
                low[entity] = min(low[entity], low[links[entity][at - 1]])
            for place in range(at, len(links[entity])):
                one = links[entity][place]
                if one not in number:
                    path += [(entity, place + 1), (one, 0)]
                    break
                if one in waiting:
                    low[entity] = min(low[entity], number[one])
            else:
                if low[entity] == number[entity]:
                    component = [open_.pop()]
                    while component[-1] != entity:
                        component.append(open_.pop())
                    waiting.difference_update(component)
                    yield component, links
