"""What identifiers of endpoints show of hosts and processes, by all that is known at one instant.

The part of an identifier that all endpoints of a process share is called its context here: 12 bytes, of which two are
the vendor's, two are bits of the host, two the low bits of the process id as the process itself sees it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from roslens.model.graph import Graph, Process

_VENDOR = "010f"
_CONTEXT = 24
_PID_BITS = 0xFFFF
_SOME = 2
"""This many processes on one host are no coincidence; fewer may be on another host that is not reported."""


class GidPlaces:
    """Hosts and processes of contexts.

    Args:
        graph: with everything that is reported.
        placed: host of each node of which an observer is sure.
        sure: host and process of contexts that were sure before, which may have ended since.
        ended: processes that did, as ``host/pid``.

    Attributes:
        nodes_of: the nodes of each context.
        contexts_of: the contexts of each node, sorted.
    """

    def __init__(
        self, graph: Graph, placed: Mapping[str, str], sure: Mapping[str, tuple[str, int]], ended: Iterable[str] = ()
    ) -> None:
        self.nodes_of: dict[str, set[str]] = {}
        for end in graph.endpoints:
            if end.gid.startswith(_VENDOR) and len(end.gid) >= _CONTEXT:
                self.nodes_of.setdefault(end.gid[:_CONTEXT], set()).add(end.node)
        self.contexts_of: dict[str, list[str]] = {}
        for context in sorted(self.nodes_of):
            for node in self.nodes_of[context]:
                self.contexts_of.setdefault(node, []).append(context)
        self._processes = _by_pid_bits(graph.processes)
        self._had = {host: set(found) for host, found in self._processes.items()}
        for name in ended:
            host, _, pid = name.rpartition("/")
            self._had.setdefault(host, set()).add(int(pid) & _PID_BITS)
        self._counted = self._counting(graph.processes, sure)
        self._host_of = self._hosts_of_bits(graph, placed)

    def of(self, context: str) -> tuple[str, int, tuple[str, ...]]:
        """Return host, process and proofs of a context; empty and 0 where they are not known."""
        host, proof = self._host_of.get(_host_bits(context), ("", ""))
        counted = self._counted.get(context)
        if counted is not None:
            return *counted, ("counters", proof) if counted[0] == host and proof == "address" else ("counters",)
        if not host:
            return "", 0, ()
        pids = self._processes.get(host, {}).get(_pid_bits(context), set())
        return host, next(iter(pids)) if len(pids) == 1 else 0, (proof,)

    def _counting(
        self, processes: Iterable[Process], sure: Mapping[str, tuple[str, int]]
    ) -> dict[str, tuple[str, int]]:
        """Return the process of each context whose nodes are claimed by a single process."""
        reported: dict[tuple[str, int], set[tuple[str, int]]] = {}
        for process in processes:
            for node in process.nodes:
                reported.setdefault((node, _seen_as(process)), set()).add((process.host, process.pid))
        found = {}
        for context, nodes in self.nodes_of.items():
            who = set().union(*(reported.get((node, _pid_bits(context)), ()) for node in nodes))
            if len(who) == 1:
                found[context] = who.pop()
            elif not who and context in sure:
                found[context] = sure[context]
        return found

    def _hosts_of_bits(self, graph: Graph, placed: Mapping[str, str]) -> dict[str, tuple[str, str]]:
        """Return the host that has the bits, and what shows it; nothing of bits of which the proofs disagree."""
        votes: dict[str, dict[str, str]] = {}
        for context, (host, _) in self._counted.items():
            votes.setdefault(_host_bits(context), {})[host] = "gid"
        for node, host in placed.items():
            bits = {_host_bits(context) for context in self.contexts_of.get(node, ())}
            if len(bits) == 1:
                votes.setdefault(bits.pop(), {})[host] = "gid"
        for host, identities in graph.identities.items():
            for identity in identities:
                votes.setdefault(identity, {})[host] = "address"
        found = {bits: next(iter(hosts.items())) for bits, hosts in votes.items() if len(hosts) == 1}
        taken = {host for hosts in votes.values() for host in hosts}
        found.update(self._by_processes(votes.keys(), self._had.keys() - taken))
        return found

    def _by_processes(self, known: Iterable[str], free: set[str]) -> dict[str, tuple[str, str]]:
        """Return the hosts of all observed processes with these bits, for bits without better evidence."""
        seen: dict[str, set[int]] = {}
        for context in self.nodes_of:
            seen.setdefault(_host_bits(context), set()).add(_pid_bits(context))
        for bits in known:
            seen.pop(bits, None)
        fits = {bits: [host for host in sorted(free) if pids <= self._had[host]] for bits, pids in seen.items()}
        claims: dict[str, int] = {}
        for hosts in fits.values():
            for host in hosts:
                claims[host] = claims.get(host, 0) + 1
        return {
            bits: (hosts[0], "processes")
            for bits, hosts in fits.items()
            if len(hosts) == 1
            and claims[hosts[0]] == 1
            and (len(seen[bits]) >= _SOME or seen[bits] == self._had[hosts[0]])
        }


def _by_pid_bits(processes: Iterable[Process]) -> dict[str, dict[int, set[int]]]:
    found: dict[str, dict[int, set[int]]] = {}
    for process in processes:
        found.setdefault(process.host, {}).setdefault(_seen_as(process), set()).add(process.pid)
    return found


def _seen_as(process: Process) -> int:
    return (process.inner or process.pid) & _PID_BITS


def _host_bits(context: str) -> str:
    return context[4:8]


def _pid_bits(context: str) -> int:
    return int(context[10:12] + context[8:10], 16)
