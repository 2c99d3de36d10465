"""Makes frames of what the graph and the counters say."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from roslens.live.adapters.ros2 import TOOL
from roslens.live.adapters.ros2.changes import Changes
from roslens.live.adapters.ros2.fit import misfits
from roslens.live.inside.counters import Counted, joined
from roslens.model.failure import Failure
from roslens.model.graph import Graph
from roslens.model.tally import Tally
from roslens.model.wire import VERSION, Frame


class Graphs(Protocol):
    """What reads the graph."""

    @property
    def unsettled(self) -> bool: ...  # noqa: D102
    def update(self) -> Graph: ...  # noqa: D102
    def sweep(self, most: int) -> bool: ...  # noqa: D102
    def ended(self, pid: int) -> bool: ...  # noqa: D102
    def node_of(self, gid: str) -> str | None: ...  # noqa: D102
    def pids(self) -> set[int]: ...  # noqa: D102


class Counters(Protocol):
    """What reads the counters of nodes."""

    def read(self, now: float) -> list[Counted]: ...  # noqa: D102
    def failures(self) -> list[Failure]: ...  # noqa: D102


class Taps(Protocol):
    """What subscribes itself."""

    def tallies(self, now: float, node_of: Callable[[str], str | None]) -> list[Tally]: ...  # noqa: D102
    def choose(self, graph: Graph) -> None: ...  # noqa: D102
    def failures(self) -> list[Failure]: ...  # noqa: D102
    def shed(self) -> int: ...  # noqa: D102


SWEEP_PER_S = 20
_GRACE_S = 60.0


class Observation:
    """One frame per period and one per change of the graph.

    Args:
        host: the name of this host.
        graphs: reads the graph.
        counters: reads what nodes count themselves.
        taps: own subscriptions; None without.
    """

    def __init__(self, host: str, graphs: Graphs, counters: Counters, taps: Taps | None = None) -> None:
        self._host = host
        self._graphs = graphs
        self._counters = counters
        self._taps = taps
        self._changes = Changes()
        self._graph: Graph | None = None
        self._there: set[tuple[str, str]] = set()
        self._told: set[Failure] = set()
        self._left: dict[str, tuple[str, float]] = {}

    @property
    def unsettled(self) -> bool:
        """Whether something was not known yet and must be asked again soon."""
        return self._graphs.unsettled

    def pids(self) -> set[int]:
        """Return the processes to watch."""
        return self._graphs.pids()

    def changed(self, now: float) -> Frame | None:
        """Return the graph and what happened, at seconds since the epoch; None where nothing did."""
        graph = self._graphs.update()
        if graph == self._graph:
            return None
        self._remember_names(graph, now)
        self._graph = graph
        self._there = {(end.node, end.name) for end in graph.endpoints}
        found = set(misfits(graph.endpoints))
        fresh = found - self._told
        # What is mended and breaks again is told again.
        self._told = found
        if self._taps is not None:
            self._taps.choose(graph)
        return self._frame(
            now, events=self._changes.to(graph, now), graph=graph, failures=sorted(fresh, key=lambda one: one.what)
        )

    def ended(self, pid: int, now: float) -> Frame | None:
        """Return what the end of a process changes."""
        return self.changed(now) if self._graphs.ended(pid) else None

    def period(self, now: float, seconds: float) -> tuple[Frame, bool]:
        """Return what was counted since the last period, and whether the graph had changed unnoticed."""
        counted = joined(self._counters.read(now), self._name_of, self._host)
        tallies = [tally for tally in counted if tally.count or self._stands(tally)]
        failures = self._counters.failures()
        shed = 0
        if self._taps is not None:
            tallies += self._taps.tallies(now, self._name_of)
            failures += self._taps.failures()
            shed = self._taps.shed()
        stale = self._graphs.sweep(max(1, round(SWEEP_PER_S * seconds)))
        return self._frame(now, tallies=tallies, failures=failures, shed=shed), stale

    def _stands(self, tally: Tally) -> bool:
        """Tell whether a connection is still there: what was taken apart is silent, and that is no news."""
        return all((name, tally.topic) in self._there for name in (tally.publisher, tally.subscriber) if name)

    def _name_of(self, gid: str) -> str | None:
        name = self._graphs.node_of(gid)
        if name is None and gid in self._left:
            return self._left[gid][0]
        return name

    def _remember_names(self, graph: Graph, now: float) -> None:
        """Keep the names of publishers that left: what they had sent is counted after they are gone."""
        there = {end.gid for end in graph.endpoints}
        for end in self._graph.endpoints if self._graph else ():
            if end.gid and end.gid not in there:
                self._left[end.gid] = (end.node, now)
        self._left = {gid: known for gid, known in self._left.items() if now - known[1] < _GRACE_S}

    def _frame(self, now: float, **parts: object) -> Frame:
        return Frame(VERSION, f"{self._host}/{TOOL}", 0, now, **parts)  # type: ignore[arg-type]
