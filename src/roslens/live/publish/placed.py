"""On which host an entity is, as far as the graph shows: of a topic or connection, where it is published."""

from __future__ import annotations

from roslens.live.publish.diagnostics import own_host
from roslens.live.system.connection_name import connection_ends
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph, Role


class Placed:
    """The hosts of what is in a graph."""

    def __init__(self, graph: Graph) -> None:
        """Look up in ``graph``."""
        self._nodes = {node.name: node.host for node in graph.nodes}
        self._topics: dict[str, set[str]] = {}
        for end in graph.endpoints:
            if end.role is Role.PUBLISHER:
                self._topics.setdefault(end.name, set()).add(self._nodes.get(end.node, ""))

    def host_of(self, entity: EntityId) -> str:
        """Return the name of the host, those of a topic with publishers on several; empty where none is known."""
        if entity.kind is EntityKind.NODE:
            return self._nodes.get(entity.name, "")
        if entity.kind is EntityKind.TOPIC:
            return ", ".join(sorted(filter(None, self._topics.get(entity.name, ()))))
        if entity.kind is EntityKind.CONNECTION:
            return self._nodes.get(connection_ends(entity)[1], "")
        return own_host(entity)
