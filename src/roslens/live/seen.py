"""Everything that a watch has seen since it began; at its end it says which sentences were about nothing of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import product

from roslens.judge.unmatched import Subject, subjects_of
from roslens.live.rulebook import Facts
from roslens.live.world import World
from roslens.model.entity import EntityKind
from roslens.model.graph import Endpoint, Graph, Node, Process, Role

MOST = 200_000
"""Parts of graphs that are remembered; of a system that makes more names than that, later ones are not."""

_End = tuple[Role, str, str, str]


class Seen:
    """What was in any graph; what is gone is remembered."""

    def __init__(self) -> None:
        self._hosts: set[str] = set()
        self._nodes: set[tuple[str, str]] = set()
        self._processes: set[tuple[str, int]] = set()
        self._ends: set[_End] = set()

    def add_graph(self, graph: Graph) -> None:
        """Remember what is in a graph."""
        if len(self._nodes) + len(self._processes) + len(self._ends) >= MOST:
            return
        self._hosts.update(graph.hosts)
        self._nodes.update((node.name, node.host) for node in graph.nodes)
        self._processes.update((process.host, process.pid) for process in graph.processes)
        self._ends.update((end.role, end.name, end.node, end.type) for end in graph.endpoints)

    def subjects(self, world: World) -> tuple[Subject, ...]:
        """Return everything that selectors can be about, of the graphs and of ``world``; sorted."""
        graph = Graph(
            "",
            tuple(Node(name, host) for name, host in self._nodes),
            tuple(Endpoint(node, role, name, type_) for role, name, node, type_ in self._ends),
            tuple(self._hosts),
            tuple(Process(host, pid) for host, pid in self._processes),
        )
        return tuple(sorted({*subjects_of(graph), *_measured(world)}))


def _measured(world: World) -> Iterator[Subject]:
    for sampled in world.sampled.values():
        if sampled.seen:
            yield from _subjects(sampled.id.kind, sampled.id.name, world.facts(sampled))
    for topic in world.topics.values():
        if topic.seen:
            yield from _subjects(EntityKind.TOPIC, topic.name, world.facts(topic))
    for connection in world.connections.values():
        facts = world.facts(connection)
        yield from _subjects(EntityKind.CONNECTION, connection.topic, facts)


def _subjects(kind: EntityKind, name: str, facts: Facts) -> Iterable[Subject]:
    ways = product(facts.hosts or ("",), facts.types or ("",), facts.publishers or ("",))
    return (Subject(kind, name, host, type_, publisher, facts.subscriber) for host, type_, publisher in ways)
