"""The union of the graphs of several observers: each knows a part, and its report replaces its previous one."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.live.join.places import Places
from roslens.model.graph import Endpoint, Graph, Node, Process


class GraphUnion:
    """The latest graph of each observer.

    Attributes:
        places: of nodes, by what several of them know.
    """

    def __init__(self) -> None:
        self._graphs: dict[str, Graph] = {}
        self.places = Places()

    def put(self, sender: str, graph: Graph) -> None:
        """Take what ``sender`` sees now."""
        self._graphs[sender] = graph

    def whole(self) -> Graph:
        """Return everything that any observer sees; of a node what those know who know most."""
        graphs = list(self._graphs.values())
        nodes: dict[str, Node] = {}
        for graph in graphs:
            for node in graph.nodes:
                known = nodes.get(node.name)
                if known is None or _known(node) > _known(known):
                    nodes[node.name] = node
        parameters: dict[str, dict[str, str]] = {}
        for graph in graphs:
            for name, values in graph.parameters.items():
                parameters.setdefault(name, {}).update(values)
        generations = {graph.generation for graph in graphs if graph.generation}
        whole = Graph(
            "+".join(sorted(generations)),
            tuple(nodes[name] for name in sorted(nodes)),
            tuple(sorted({one for graph in graphs for one in graph.endpoints}, key=_order)),
            tuple(sorted({host for graph in graphs for host in graph.hosts})),
            _processes(graphs),
            parameters,
            {host: found for graph in graphs for host, found in sorted(graph.identities.items())},
        )
        return self.places.place(whole)


def _known(node: Node) -> int:
    return bool(node.host) + 2 * bool(node.pid) + bool(node.lifecycle)


def _processes(graphs: Iterable[Graph]) -> tuple[Process, ...]:
    """Return each process once, with its nodes known to any observer."""
    found: dict[tuple[str, int], Process] = {}
    for process in sorted(process for graph in graphs for process in graph.processes):
        known = found.get((process.host, process.pid), process)
        found[process.host, process.pid] = msgspec.structs.replace(
            process,
            command=process.command or known.command,
            started=process.started or known.started,
            nodes=tuple(sorted({*known.nodes, *process.nodes})),
            inner=process.inner or known.inner,
        )
    return tuple(found[key] for key in sorted(found))


def _order(endpoint: Endpoint) -> tuple[str, ...]:
    # Not the endpoints themselves: a quality of service and none have no order between them.
    return (endpoint.name, endpoint.role.value, endpoint.node, endpoint.gid, endpoint.type, endpoint.hash)
