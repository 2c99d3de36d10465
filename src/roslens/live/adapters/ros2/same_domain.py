"""Whose counters are of the domain that is observed: processes of all domains count in the same folder.

The identifiers of a node's endpoints hold the low 16 bits of its process id, and a counter file the whole of it. A node
of the same name in another domain has another process. Where the identifiers of a node are of another layout its name
alone has to do; those of other participants show nothing of it.
"""

from __future__ import annotations

from roslens.live.adapters.ros2.gid import pid_bits
from roslens.model.graph import Graph

KEPT_S = 60.0
"""What a node had sent is counted after it is gone."""
_BITS = 0xFFFF


class SameDomain:
    """Knows which nodes are in which processes, by the graph of one domain."""

    def __init__(self) -> None:
        self._there: set[tuple[str, int]] = set()
        self._left: dict[tuple[str, int], float] = {}
        self._other_layout: set[str] = set()

    def take(self, graph: Graph, now: float) -> None:
        """Take who is there at ``now``."""
        there = set()
        self._other_layout = set()
        for end in graph.endpoints:
            if not end.gid:
                continue
            bits = pid_bits(end.gid)
            if bits is None:
                self._other_layout.add(end.node)
            else:
                there.add((end.node, bits))
        self._left.update(dict.fromkeys(self._there - there, now))
        self._left = {one: when for one, when in self._left.items() if now - when < KEPT_S}
        self._there = there

    def has(self, node: str, pid: int) -> bool:
        """Return whether what ``node`` counts in the process ``pid``, as that sees itself, is of this domain."""
        one = (node, pid & _BITS)
        return node in self._other_layout or one in self._there or one in self._left
