"""Where nodes live, or lived last, and in which ROS: who is gone has to be started where and as what it was."""

from __future__ import annotations

import msgspec

from roslens.model.graph import Graph

_MOST = 10_000
_BY_SLASHES = {1: 1, 2: 2}
"""``package/Type`` is of ROS 1, ``package/msg/Type`` of ROS 2."""


class Home(msgspec.Struct, frozen=True):
    """Host and process of a node, and who else lived in that process; ``pid`` 0 is unknown."""

    host: str
    pid: int
    beside: tuple[str, ...] = ()


class NodePlaces:
    """Remembers the last place of each node."""

    def __init__(self) -> None:
        self._homes: dict[str, Home] = {}
        self._generations: dict[str, frozenset[int]] = {}

    def take(self, graph: Graph) -> None:
        """Take what is there now."""
        self._take_homes(graph)
        self._take_generations(graph)
        for kept in (self._homes, self._generations):
            while len(kept) > _MOST:
                del kept[next(iter(kept))]

    def _take_homes(self, graph: Graph) -> None:
        within: dict[tuple[str, int], list[str]] = {}
        for node in graph.nodes:
            if node.instances:
                # Which of them would be ended is anybody's guess.
                self._homes[node.name] = Home(node.host, 0)
            elif node.host and node.pid:
                within.setdefault((node.host, node.pid), []).append(node.name)
        for (host, pid), names in within.items():
            for name in names:
                self._homes[name] = Home(host, pid, tuple(one for one in names if one != name))
        for node in graph.nodes:
            if node.host and not node.pid and node.name not in self._homes:
                self._homes[node.name] = Home(node.host, 0)

    def _take_generations(self, graph: Graph) -> None:
        # Nodes of a union are of one generation or the other; the types of their ends are written differently.
        seen: dict[str, set[int]] = {}
        for end in graph.endpoints:
            if end.type.count("/") in _BY_SLASHES:
                seen.setdefault(end.node, set()).add(_BY_SLASHES[end.type.count("/")])
        self._generations.update((name, frozenset(found)) for name, found in seen.items())

    def of(self, node: str) -> Home | None:
        """Return the host of a node, or its last one; None if it is unknown."""
        return self._homes.get(node)

    def generations_of(self, node: str) -> frozenset[int]:
        """Return the generations of ROS that a node is, or was last, in; empty if unknown."""
        return self._generations.get(node, frozenset())
