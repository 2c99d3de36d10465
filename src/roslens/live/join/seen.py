"""Everything that a watch has observed; at its end it reports the constraints that matched nothing of it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import product

from roslens.judge.reference.unmatched import Subject, subjects_of
from roslens.live.standing.rulebook import Facts
from roslens.live.system.world import World
from roslens.model.entity import EntityKind
from roslens.model.graph import Endpoint, Graph, Node, Process, Role

MOST = 200_000
"""Parts of graphs that are remembered; of a system that makes more names than that, later ones are not."""
MOST_ALIKE = 100
"""Of names that differ in their digits alone, as those of command line tools do: many show what is true of others."""
_NUMBER = re.compile(r"\d+")

_End = tuple[Role, str, str, str]


class Seen:
    """What was in any graph; what is gone is remembered."""

    def __init__(self) -> None:
        self._hosts: set[str] = set()
        self._nodes: set[tuple[str, str]] = set()
        self._alike: dict[tuple[str, ...], int] = {}
        self._processes: set[tuple[str, int]] = set()
        self._ends: set[_End] = set()
        self._parameters: set[tuple[str, str]] = set()

    def add_graph(self, graph: Graph) -> None:
        """Remember what is in a graph."""
        if len(self._nodes) + len(self._processes) + len(self._ends) + len(self._parameters) >= MOST:
            return
        for node_name, values in graph.parameters.items():
            self._parameters.update((node_name, name) for name in values)
        self._hosts.update(graph.hosts)
        for node in graph.nodes:
            if (one := (node.name, node.host)) not in self._nodes and self._is_new(*one):
                self._nodes.add(one)
        for process in graph.processes:
            if (known := (process.host, process.pid)) not in self._processes and self._is_new(process.host):
                self._processes.add(known)
        for end in graph.endpoints:
            if (tie := (end.role, end.name, end.node, end.type)) not in self._ends and self._is_new(*tie):
                self._ends.add(tie)

    def _is_new(self, *words: str) -> bool:
        """Count one more of what is written so, numbers apart; return whether few enough are known."""
        shape = tuple(_NUMBER.sub("0", word) for word in words)
        many = self._alike.get(shape, 0)
        if many < MOST_ALIKE:
            self._alike[shape] = many + 1
        return many < MOST_ALIKE

    def subjects(self, world: World) -> tuple[Subject, ...]:
        """Return everything that selectors can be about, of the graphs and of ``world``; sorted."""
        graph = Graph(
            "",
            tuple(Node(name, host) for name, host in self._nodes),
            tuple(Endpoint(node, role, name, type_) for role, name, node, type_ in self._ends),
            tuple(self._hosts),
            tuple(Process(host, pid) for host, pid in self._processes),
            {node: dict.fromkeys(names, "") for node, names in self._by_node().items()},
        )
        return tuple(sorted({*subjects_of(graph), *_measured(world)}))

    def _by_node(self) -> dict[str, list[str]]:
        found: dict[str, list[str]] = {}
        for node, name in self._parameters:
            found.setdefault(node, []).append(name)
        return found


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
