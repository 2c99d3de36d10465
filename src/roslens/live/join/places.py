"""Where nodes run, by what several observers know of it: one alone sees the processes of its own host.

An observer of ROS 1 knows the address at which a node answers, and a listener which host it is that has this address.
An observer of ROS 2 knows identifiers of endpoints, in which there are 16 bits of a host and 16 bits of a process id
(Fast DDS, `adapters/ros2/gid.py`). In containers process ids are small and the same everywhere, so they show a host
only together with something else. A node's proofs say what it was:

- ``counters``: the process of the node counts in the memory of this host, under this name and process id
- ``address``: the addresses of this host yield the bits (`agent/identity.py`), and those of no other
- ``gid``: somebody is sure of the place of another node with the same bits
- ``processes``: nobody tells anything better, and all processes that are seen with the bits are on this host, which
  has all of no other bits

All is found anew from what is known now. What contradicts itself shows nothing: unknown is better than wrong.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

import msgspec

from roslens.live.join.gid_places import GidPlaces
from roslens.live.join.instances import contexts_by_node, instances_of
from roslens.model.graph import Change, Event, Graph, Node


class _Known(NamedTuple):
    """The process of a context, and what showed it."""

    host: str
    pid: int
    proofs: tuple[str, ...]

    @property
    def process(self) -> str:
        return f"{self.host}/{self.pid}"


class Places:
    """Completes the hosts and processes of nodes; leaves out nodes of which all processes ended."""

    def __init__(self) -> None:
        self._host_at: dict[str, str] = {}
        self._process_of: dict[str, _Known] = {}
        self._ended: set[str] = set()

    def know(self, hosts: Mapping[str, str]) -> bool:
        """Take which host has which address; return whether that is news."""
        news = hosts.items() - self._host_at.items()
        self._host_at.update(news)
        return bool(news)

    def happened(self, events: Iterable[Event]) -> bool:
        """Note which processes ended; return whether one did."""
        before = len(self._ended)
        for event in events:
            if not event.entity.startswith("process:"):
                continue
            name = event.entity.partition(":")[2]
            if event.change is Change.VANISHED:
                self._ended.add(name)
            elif event.change is Change.APPEARED:
                self._ended.discard(name)
        return len(self._ended) > before

    def place(self, graph: Graph) -> Graph:
        """Return the graph with what is known of its nodes' places."""
        sure = {context: (one.host, one.pid) for context, one in self._process_of.items() if "counters" in one.proofs}
        placed = {node.name: self._host_at.get(node.host, node.host) for node in graph.nodes if node.host}
        gids = GidPlaces(graph, placed, sure, self._ended)
        self._remember(gids)
        nodes = []
        gone = set()
        dead = {context for context, one in self._process_of.items() if one.process in self._ended}
        contexts = contexts_by_node(graph.endpoints, dead)
        for node in graph.nodes:
            found = self._placed(node, gids)
            if found is None:
                gone.add(node.name)
            else:
                several = instances_of(node, contexts.get(node.name, ()), lambda one: self._place_of(one, gids)[:2])
                nodes.append(msgspec.structs.replace(found, instances=several) if several else found)
        listed = {f"{process.host}/{process.pid}" for process in graph.processes}
        known = {one.process for one in self._process_of.values()}
        self._ended &= listed | known | _named(graph, self._host_at)
        return msgspec.structs.replace(
            graph,
            nodes=tuple(nodes),
            endpoints=tuple(end for end in graph.endpoints if end.node not in gone and end.gid[:24] not in dead),
            hosts=tuple(sorted({self._host_at.get(host, host) for host in graph.hosts})),
        )

    def _remember(self, gids: GidPlaces) -> None:
        """Note the process of each context; one that ended is still known where nothing contradicts it."""
        known: dict[str, _Known] = {}
        for context in gids.nodes_of:
            host, pid, proofs = gids.of(context)
            before = self._process_of.get(context)
            if pid:
                known[context] = _Known(host, pid, proofs)
            elif before is not None and (before.host == host or (not host and "counters" in before.proofs)):
                known[context] = before
        self._process_of = known

    def _placed(self, node: Node, gids: GidPlaces) -> Node | None:
        if node.host:
            host = self._host_at.get(node.host, node.host)
            if f"{host}/{node.pid}" in self._ended:
                return None
            return node if host == node.host else msgspec.structs.replace(node, host=host)
        own = gids.contexts_of.get(node.name, ())
        alive = [context for context in own if not self._is_over(context)]
        if own and not alive:
            return None
        found = {self._place_of(context, gids) for context in alive}
        hosts = {one.host for one in found}
        if len(hosts) != 1 or not (host := hosts.pop()):
            return node
        # A name that several processes bear has no process of its own.
        one = (
            found.pop()
            if len(alive) == 1
            else _Known("", 0, tuple(sorted({word for one in found for word in one.proofs})))
        )
        return msgspec.structs.replace(node, host=host, pid=one.pid, proofs=one.proofs)

    def _is_over(self, context: str) -> bool:
        known = self._process_of.get(context)
        return known is not None and known.process in self._ended

    def _place_of(self, context: str, gids: GidPlaces) -> _Known:
        return self._process_of.get(context) or _Known(*gids.of(context))


def _named(graph: Graph, host_at: Mapping[str, str]) -> set[str]:
    return {f"{host_at.get(node.host, node.host)}/{node.pid}" for node in graph.nodes if node.host and node.pid}
