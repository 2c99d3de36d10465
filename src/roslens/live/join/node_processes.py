"""Which nodes live in which process, so that what a process uses can be attributed to its nodes.

Nodes that share a process each get its values: they are never divided among them, because nobody can know the shares.
"""

from __future__ import annotations

import msgspec

from roslens.live.window.newest import MOST_GONE, keep_newest
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph
from roslens.model.traffic.sample import Sample


class NodeProcesses:
    """Joins graphs and samples of processes; counts how often a node came back in another process."""

    def __init__(self) -> None:
        self._nodes_of: dict[str, list[str]] = {}
        self._process_of: dict[str, str] = {}
        self._restarts: dict[str, int] = {}
        self._by_sender: dict[str, dict[str, str]] = {}

    def add_graph(self, sender: str, graph: Graph) -> None:
        """Take the graph that an observer sees now; nodes whose process it does not know are left as they were."""
        known = {f"{node.name}": f"{node.host}/{node.pid}" for node in graph.nodes if node.pid and node.host}
        self._by_sender[sender] = known
        for node, process in known.items():
            before = self._process_of.pop(node, None)
            if before is not None and before != process:
                self._restarts[node] = self._restarts.get(node, 0) + 1
            self._process_of[node] = process
        keep_newest(self._process_of, sum(map(len, self._by_sender.values())) + MOST_GONE)
        if len(self._restarts) > len(self._process_of):
            self._restarts = {node: many for node, many in self._restarts.items() if node in self._process_of}
        self._nodes_of = {}
        for mapping in self._by_sender.values():
            for node, process in mapping.items():
                nodes = self._nodes_of.setdefault(process, [])
                if node not in nodes:
                    nodes.append(node)

    def of(self, sample: Sample) -> list[Sample]:
        """Return the samples of the nodes in the process that was sampled; none for other entities."""
        if sample.entity.kind is not EntityKind.PROCESS:
            return []
        found = []
        for node in sorted(self._nodes_of.get(sample.entity.name, ())):
            values = {**sample.values, "restarts": float(self._restarts.get(node, 0))}
            found.append(msgspec.structs.replace(sample, entity=EntityId(EntityKind.NODE, node), values=values))
        return found

    def process_of(self, node: str) -> str:
        """Return the process of a node as ``<host>/<pid>``; empty where it is not known."""
        return self._process_of.get(node, "")
