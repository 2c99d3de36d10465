"""What nodes count, as the agent asks for it, and which process that is of those it sees."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

import msgspec

from roslens.model.failure import Failure
from roslens.model.graph import Process
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Tally


class Counters(Protocol):
    """Reads what all nodes of a host count."""

    def read(self, now: float) -> Sequence[tuple[str, list[Tally]]]:
        """Return what was counted since the last read, by place of the counters."""

    def calls(self, now: float) -> Sequence[tuple[str, list[Sample]]]:
        """Return what was counted of services since this was last asked, by place of the counters."""

    def nodes(self) -> Mapping[int, frozenset[str]]:
        """Return who counts in which process, by the id that the process sees itself."""

    def places(self) -> list[str]:
        """Return where is counted."""

    def failures(self) -> list[Failure]:
        """Return what went wrong since this was last asked."""

    def close(self) -> None:
        """Let go of everything."""


def with_nodes(processes: Iterable[Process], nodes: Mapping[int, frozenset[str]]) -> tuple[Process, ...]:
    """Return processes with the nodes that count in them; where two see the same id of themselves, with none."""
    known = tuple(processes)
    seen: dict[int, int] = {}
    for process in known:
        own = process.inner or process.pid
        seen[own] = seen.get(own, 0) + 1
    found = []
    for process in known:
        own = process.inner or process.pid
        counting = nodes.get(own, ()) if seen[own] == 1 else ()
        found.append(msgspec.structs.replace(process, nodes=tuple(sorted(counting))) if counting else process)
    return tuple(found)
