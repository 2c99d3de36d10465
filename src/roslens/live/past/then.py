"""The tree of a system as it stood at an instant of its history."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from roslens.live.system.connection_name import connection_ends
from roslens.live.system.tree import SystemView, tree_of
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph, Role
from roslens.model.verdict import State
from roslens.store.past.moment import Moment

_SAMPLED = (EntityKind.HOST, EntityKind.NODE, EntityKind.PROCESS, EntityKind.SERVICE)


def tree_then(moment: Moment, values: Mapping[str, dict[str, float]]) -> SystemView:
    """Return the tree of a moment with the values of that time, by text form of the id of the entity."""
    states: dict[EntityId, list[State]] = {}
    for one in moment.verdicts:
        states.setdefault(one.entity, []).append(one.state)
    return tree_of(_Then(moment, values, states), states)


class _Then:
    """The parts of a system that was."""

    def __init__(self, moment: Moment, values: Mapping[str, dict[str, float]], states: Iterable[EntityId]) -> None:
        self.graph: Graph | None = moment.graph
        self._moment = moment
        self._values: dict[EntityId, dict[str, float]] = {}
        for text, known in values.items():
            try:
                self._values[EntityId.parse(text)] = known
            except ValueError:
                continue
        self._hosts = {node.name: node.host for node in moment.graph.nodes if node.host}
        self._publishers: dict[str, set[str]] = {name: set(nodes) for name, nodes in moment.former.items()}
        self._connections: dict[tuple[str, str], set[EntityId]] = {}
        self._topics: set[str] = set(moment.former)
        for end in moment.graph.endpoints:
            if end.role is Role.PUBLISHER:
                self._publishers.setdefault(end.name, set()).add(end.node)
            if end.role in (Role.PUBLISHER, Role.SUBSCRIPTION):
                self._topics.add(end.name)
        for entity in (*self._values, *states):
            self._place(entity)

    def _place(self, entity: EntityId) -> None:
        if entity.kind is EntityKind.TOPIC:
            self._topics.add(entity.name)
        elif entity.kind is EntityKind.CONNECTION:
            topic, publisher, _ = connection_ends(entity)
            self._topics.add(topic)
            self._connections.setdefault((topic, publisher), set()).add(entity)
            if publisher:
                self._publishers.setdefault(topic, set()).add(publisher)

    @property
    def sampled(self) -> Collection[EntityId]:
        return [one for one in self._values if one.kind in _SAMPLED]

    @property
    def topics(self) -> Iterable[str]:
        return self._topics

    def host_of(self, node: str) -> str:
        return self._hosts.get(node) or self._moment.hosts.get(node, "")

    def publishers_of(self, topic: str) -> Iterable[str]:
        return self._publishers.get(topic, ())

    def connections_of(self, topic: str, node: str) -> Iterable[EntityId]:
        return self._connections.get((topic, node), ())

    def values_of(self, entity: EntityId) -> tuple[dict[str, float], str]:
        values = self._values.get(entity, {})
        return values, self._moment.observers.get(str(entity), "") if values else ""
