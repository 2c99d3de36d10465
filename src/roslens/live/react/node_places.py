"""Where nodes live, or lived last: who is gone has to be started on the host and as the process that it was."""

from __future__ import annotations

import msgspec

from roslens.model.graph import Graph

_MOST = 10_000


class Home(msgspec.Struct, frozen=True):
    """Host and process of a node, and who else lived in that process; ``pid`` 0 is unknown."""

    host: str
    pid: int
    beside: tuple[str, ...] = ()


class NodePlaces:
    """Remembers the last place of each node."""

    def __init__(self) -> None:
        self._homes: dict[str, Home] = {}

    def take(self, graph: Graph) -> None:
        """Take what is there now."""
        within: dict[tuple[str, int], list[str]] = {}
        for node in graph.nodes:
            if node.host and node.pid:
                within.setdefault((node.host, node.pid), []).append(node.name)
        for (host, pid), names in within.items():
            for name in names:
                self._homes[name] = Home(host, pid, tuple(one for one in names if one != name))
        for node in graph.nodes:
            if node.host and not node.pid and node.name not in self._homes:
                self._homes[node.name] = Home(node.host, 0)
        while len(self._homes) > _MOST:
            del self._homes[next(iter(self._homes))]

    def of(self, node: str) -> Home | None:
        """Return where a node lives, or lived last; None where nobody saw that."""
        return self._homes.get(node)
