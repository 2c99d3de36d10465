"""Who is there, who is gone, and what befell them: by the graph and its events."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.acting.process_end import in_order
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change, Event, Graph, Node, Role

BEFELL_S = 10.0
"""So long it counts that something was restarted, or that it flaps."""
TOGETHER_S = 10.0
"""Nodes of a host that vanish within this time vanish together: the host went down, or all were shut down."""
MOST_GONE = 10_000
"""Of what is gone so many are remembered, the latest."""
_ENDS = {
    Role.PUBLISHER: EntityKind.TOPIC,
    Role.SUBSCRIPTION: EntityKind.TOPIC,
    Role.SERVICE_SERVER: EntityKind.SERVICE,
}
_BEFELL = (Change.RESTARTED, Change.FLAPPING)


class Ended(msgspec.Struct, frozen=True):
    """The end of the process of a node.

    Attributes:
        process: as ``host/pid``.
        at: when it ended.
        how: as `model/acting/process_end.py` writes it.
        in_graph: whether the node was still in the graph when its process was gone: it did not take its leave.
    """

    process: str
    at: float
    how: str
    in_graph: bool

    @property
    def in_order(self) -> bool:
        """Whether it was asked to end, or was done; where nobody saw its status, whether it took its leave."""
        known = in_order(self.how)
        return not self.in_graph if known is None else known


class Presences:
    """What was ever there, and since when it is or is not; times are seconds on the monitor's clock."""

    def __init__(self) -> None:
        """Start without any node."""
        self._there: dict[EntityId, float] = {}
        self._gone: dict[EntityId, float] = {}
        self._ends: dict[str, Ended] = {}
        self._since: dict[str, float] = {}
        self._befell: dict[tuple[EntityId, Change], float] = {}
        self._hosts: dict[str, str] = {}
        self._lifecycles: dict[str, str] = {}
        self._process_of: dict[str, str] = {}

    def there(self, entity: EntityId) -> float | None:
        """Return since when something is there; None where it is not, or never was."""
        return self._there.get(entity)

    def gone(self, entity: EntityId) -> float | None:
        """Return since when something is gone; None where it is there, or never was."""
        return self._gone.get(entity)

    def crashed(self, node: EntityId) -> float | None:
        """Return when a node went with its process, which was not asked to end; None of any other."""
        ended = self.end_of(node)
        return ended.at if ended is not None and not ended.in_order else None

    def end_of(self, node: EntityId) -> Ended | None:
        """Return how the process of a node that is gone ended; None where its end was not seen, or of the living."""
        ended = self._ends.get(node.name) if node in self._gone and node.kind is EntityKind.NODE else None
        return ended if ended is not None and ended.process == self._process_of.get(node.name) else None

    def began(self, node: EntityId) -> float | None:
        """Return since when a node that is gone had been there; None where that is not known."""
        return self._since.get(node.name) if node in self._gone else None

    def befell(self, entity: EntityId, change: Change, now: float) -> float | None:
        """Return when something was restarted, or found to flap, in the latest ``BEFELL_S``."""
        at = self._befell.get((entity, change))
        return at if at is not None and now - at <= BEFELL_S else None

    def troubled(self, entity: EntityId) -> bool:
        """Whether something is gone, or was ever restarted or found to flap."""
        return entity in self._gone or any((entity, change) in self._befell for change in _BEFELL)

    def went_with_host(self, node: EntityId) -> bool:
        """Whether all nodes of the host vanished with a node: its host is off, or all were shut down."""
        at, host = self._gone.get(node), self._hosts.get(node.name, "")
        if at is None or not host:
            return False
        nodes = [EntityId(EntityKind.NODE, name) for name, where in self._hosts.items() if where == host]
        together = sum(abs(self._gone.get(one, float("inf")) - at) <= TOGETHER_S for one in nodes)
        return together > 1 and not any(one in self._there for one in nodes)

    def host_of(self, node: str) -> str:
        """Return where a node is or was; empty where that is unknown."""
        return self._hosts.get(node, "")

    def lifecycle(self, node: str) -> str:
        """Return the state of a managed node that is there; empty where that is unknown."""
        return self._lifecycles.get(node, "")

    def ever(self, kind: EntityKind) -> Iterator[EntityId]:
        """Yield what of a kind was ever there."""
        for part in (self._there, self._gone):
            yield from (one for one in part if one.kind is kind)

    def happened(self, event: Event) -> bool:
        """Take a change of the graph; return whether it adds something new."""
        try:
            entity = EntityId.parse(event.entity)
        except ValueError:
            return False
        if event.change in _BEFELL:
            self._befell[entity, event.change] = event.time
        if event.change is Change.VANISHED:
            if entity.kind is EntityKind.PROCESS:
                self._ended(entity, event)
            elif entity.kind is EntityKind.NODE and event.ended:
                self._went_with(entity.name, self._process_of.get(entity.name, ""), event)
            self._go(entity, event.time)
        elif event.change in (Change.APPEARED, Change.RESTARTED):
            return self._appear(entity, event.time)
        return False

    def take_graph(self, graph: Graph, now: float) -> None:
        """Take the whole graph as it is at ``now``."""
        for node in graph.nodes:
            if node.host:
                self._hosts[node.name] = node.host
        self._lifecycles = {node.name: node.lifecycle for node in graph.nodes if node.lifecycle}
        for node in graph.nodes:
            if node.pid:
                self._live_in(node)
        existing = {EntityId(EntityKind.NODE, node.name) for node in graph.nodes}
        existing |= {EntityId(EntityKind.HOST, host) for host in (*graph.hosts, *self._hosts_of(graph))}
        existing |= {EntityId(EntityKind.PROCESS, f"{one.host}/{one.pid}") for one in graph.processes}
        existing |= {EntityId(_ENDS[end.role], end.name) for end in graph.endpoints if end.role in _ENDS}
        for entity in existing:
            self._appear(entity, now)
        for entity in sorted(self._there.keys() - existing):
            self._go(entity, now)
        while len(self._gone) > MOST_GONE:
            self._forget(next(iter(self._gone)))

    def _forget(self, entity: EntityId) -> None:
        del self._gone[entity]
        if entity.kind is EntityKind.NODE:
            for kept in (self._hosts, self._ends, self._since, self._process_of):
                kept.pop(entity.name, None)

    def _hosts_of(self, graph: Graph) -> set[str]:
        return {node.host for node in graph.nodes if node.host}

    def _appear(self, entity: EntityId, at: float) -> bool:
        if entity in self._there:
            return False
        self._there[entity] = at
        if entity.kind is EntityKind.NODE:
            self._ends.pop(entity.name, None)
        return self._gone.pop(entity, None) is None

    def _go(self, entity: EntityId, at: float) -> None:
        since = self._there.pop(entity, None)
        if since is None:
            return
        self._gone[entity] = at
        if entity.kind is EntityKind.NODE:
            self._since[entity.name] = since

    def _live_in(self, node: Node) -> None:
        """Note the process of a node; what is known of the end of another one is not about it."""
        process = f"{node.host}/{node.pid}"
        self._process_of[node.name] = process
        ended = self._ends.get(node.name)
        if ended is not None and ended.process != process:
            del self._ends[node.name]

    def _ended(self, process: EntityId, event: Event) -> None:
        """Note how a process ended, for the nodes that were last in it: they may have left the graph before."""
        for name, where in self._process_of.items():
            if where == process.name:
                self._went_with(name, where, event)

    def _went_with(self, name: str, process: str, event: Event) -> None:
        known = self._ends.get(name)
        if known is not None and known.process == process:
            # Two observers see the end of one process: who knows how it ended is right, in whatever order they tell.
            how = event.ended if in_order(known.how) is None and event.ended else known.how
            self._ends[name] = msgspec.structs.replace(known, how=how)
            return
        there = EntityId(EntityKind.NODE, name) in self._there
        self._ends[name] = Ended(process, event.time, event.ended, in_graph=there)
