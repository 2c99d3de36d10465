"""Where nodes run, by what several observers know of it: one alone sees the processes of its own host.

An observer of ROS 1 knows the address at which a node answers, and a listener which host it is that has this address.
An observer of ROS 2 knows identifiers of endpoints, in which there are 16 bits of a host and 16 bits of the process id
(Fast DDS, `adapters/ros2/gid.py`); agents know the processes of their hosts. Bits of a host belong to the one host
whose agent knows all the processes that are seen with them, where there is but one that is not taken.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import msgspec

from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change, Event, Graph, Node

_VENDOR = "010f"
_BITS = 0xFFFF


class Places:
    """Completes the hosts and processes of nodes; leaves out nodes of which all processes ended."""

    def __init__(self) -> None:
        self._host_at: dict[str, str] = {}
        self._host_by_bits: dict[str, str] = {}
        self._process_of: dict[str, tuple[str, int]] = {}
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
            name = EntityId.parse(event.entity).name
            if event.change is Change.VANISHED:
                self._ended.add(name)
            elif event.change is Change.APPEARED:
                self._ended.discard(name)
        return len(self._ended) > before

    def place(self, graph: Graph) -> Graph:
        """Return the graph with what is known of its nodes' places."""
        processes: dict[str, dict[int, int]] = {}
        for process in graph.processes:
            processes.setdefault(process.host, {})[process.pid & _BITS] = process.pid
        contexts = _contexts(graph)
        self._match(graph, contexts, processes)
        self._process_of = {context: known for context, known in self._process_of.items() if context in contexts}
        nodes = []
        ended = set()
        for node in graph.nodes:
            placed = self._placed(node, contexts, processes)
            if placed is None:
                ended.add(node.name)
            else:
                nodes.append(placed)
        listed = {EntityId(EntityKind.PROCESS, f"{process.host}/{process.pid}").name for process in graph.processes}
        self._ended &= (
            listed | {f"{host}/{pid}" for host, pid in self._process_of.values()} | _named(graph, self._host_at)
        )
        return msgspec.structs.replace(
            graph,
            nodes=tuple(nodes),
            endpoints=tuple(end for end in graph.endpoints if end.node not in ended),
            hosts=tuple(sorted({self._host_at.get(host, host) for host in graph.hosts})),
        )

    def _match(self, graph: Graph, contexts: dict[str, str], processes: dict[str, dict[int, int]]) -> None:
        """Find out which host has which bits, one after the other, as the others become taken."""
        placed = {node.name: node.host for node in graph.nodes if node.host}
        seen: dict[str, set[int]] = {}
        for context, node in contexts.items():
            if node in placed:
                self._host_by_bits[context[4:8]] = placed[node]
            else:
                seen.setdefault(context[4:8], set()).add(int(context[10:12] + context[8:10], 16))
        moved = True
        while moved:
            moved = False
            for bits in sorted(seen.keys() - self._host_by_bits.keys()):
                free = sorted(processes.keys() - set(self._host_by_bits.values()))
                fit = [host for host in free if seen[bits] <= processes[host].keys()]
                if len(fit) == 1:
                    self._host_by_bits[bits] = fit[0]
                    moved = True

    def _placed(self, node: Node, contexts: dict[str, str], processes: dict[str, dict[int, int]]) -> Node | None:
        if node.host:
            host = self._host_at.get(node.host, node.host)
            if f"{host}/{node.pid}" in self._ended:
                return None
            return node if host == node.host else msgspec.structs.replace(node, host=host)
        own = [context for context, name in contexts.items() if name == node.name]
        hosts = {self._host_by_bits.get(context[4:8], "") for context in own}
        for context in own:
            host = self._host_by_bits.get(context[4:8], "")
            pid = processes.get(host, {}).get(int(context[10:12] + context[8:10], 16))
            if pid is not None:
                self._process_of.setdefault(context, (host, pid))
        found = [self._process_of.get(context) for context in own]
        alive = [one for one in found if one is None or f"{one[0]}/{one[1]}" not in self._ended]
        if own and not alive:
            return None
        if len(hosts) != 1 or not (host := hosts.pop()):
            return node
        known = [one for one in alive if one is not None]
        pid = known[0][1] if len(alive) == len(known) == 1 else 0
        return msgspec.structs.replace(node, host=host, pid=pid, proofs=("gid",))


def _contexts(graph: Graph) -> dict[str, str]:
    """Return the node of each context: what all endpoints of a process share of their identifiers."""
    return {end.gid[:24]: end.node for end in graph.endpoints if end.gid.startswith(_VENDOR) and len(end.gid) >= 24}


def _named(graph: Graph, host_at: Mapping[str, str]) -> set[str]:
    return {f"{host_at.get(node.host, node.host)}/{node.pid}" for node in graph.nodes if node.host and node.pid}
