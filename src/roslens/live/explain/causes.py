"""Which fault explains which: the first bad entity upstream of each bad one.

Upstream of a topic are the nodes that publish it, of a node the topics it subscribes to and its host, of a connection
its topic and publisher. A topic that is judged fine ends the search, since data flows there. In a cycle the fault that
began first is the cause. What matters more is never explained by what matters less: a warning about a host may be why
a topic is slow, but nobody who reads it would look for the error. Of several that explain a fault it is the gravest,
of these the first. Tarjan's strongly connected components make one pass enough.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from roslens.model.entity import EntityId, EntityKind
from roslens.model.relations.strongly_connected import strongly_connected

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
    links: dict[EntityId, list[EntityId]] = {}
    faults = _Faults(bad, weights or {}, until or {})

    def open_upstream(entity: EntityId) -> list[EntityId]:
        links[entity] = sorted(
            one
            for one in upstream(entity)
            if one in bad or not (one.kind in (EntityKind.TOPIC, EntityKind.CONNECTION) and fine(one))
        )
        return links[entity]

    for component in strongly_connected(sorted(bad), open_upstream):
        members = set(component)
        sources = [carried[one] for entity in component for one in links[entity] if one not in members]
        inside = sorted((entity for entity in component if entity in bad), key=faults.order)
        roots = faults.roots(sources, inside)
        for entity in component:
            carried[entity] = roots
        for entity in inside:
            root = roots[faults.weight_of[entity]]
            if entity != root:
                causes[entity] = root
    return causes


class _Faults:
    """Bad entities: since when, how much each matters, and what may have caused which."""

    def __init__(
        self, since: Mapping[EntityId, float], weights: Mapping[EntityId, int], until: Mapping[EntityId, float]
    ) -> None:
        self.weight_of = {entity: weights.get(entity, 0) for entity in since}
        self._levels = sorted(set(self.weight_of.values()), reverse=True)
        self._since = since
        self._until = until

    def order(self, entity: EntityId) -> tuple[float, EntityId]:
        """Return by what the first of several is found."""
        return self._since[entity], entity

    def roots(self, sources: Sequence[_Roots], inside: Sequence[EntityId]) -> _Roots:
        """Return the roots of a component: those of its sources, or the first of what is bad inside."""
        roots: _Roots = {}
        graver: list[EntityId] = []
        for level in self._levels:
            outside = min((found[level] for found in sources if level in found), key=self.order, default=None)
            graver += [outside] if outside is not None else []
            first = next((entity for entity in inside if self.weight_of[entity] >= level), None)
            root = outside if first is None else next((one for one in graver if self._explains(one, first)), first)
            if root is not None:
                roots[level] = root
        return roots

    def _explains(self, cause: EntityId, fault: EntityId) -> bool:
        latest = self._until.get(cause, float("inf"))
        return self._since[cause] - LATE_S <= self._since[fault] <= latest
