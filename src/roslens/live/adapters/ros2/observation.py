"""Makes frames of the graph and the counters."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import msgspec

from roslens.live.adapters.ros2 import TOOL
from roslens.live.adapters.ros2.changes import Changes
from roslens.live.adapters.ros2.parameters import Parameters
from roslens.live.adapters.ros2.reported_topics import Reported
from roslens.live.adapters.ros2.same_domain import SameDomain
from roslens.live.inside.call_times import CallTimes
from roslens.live.inside.counters import Called, Counted, joined
from roslens.live.join.instances import several_publishers
from roslens.live.system.misfit import misfits
from roslens.model.acting.process_end import UNKNOWN
from roslens.model.failure import Failure
from roslens.model.graph import Graph
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Tally
from roslens.model.wire import VERSION, Frame


class Graphs(Protocol):
    """What reads the graph."""

    @property
    def unsettled(self) -> bool: ...  # noqa: D102
    def update(self) -> Graph: ...  # noqa: D102
    def sweep(self, most: int) -> bool: ...  # noqa: D102
    def ended(self, pid: int) -> bool: ...  # noqa: D102
    def node_of(self, gid: str) -> str | None: ...  # noqa: D102
    def own(self, gid: str) -> bool: ...  # noqa: D102
    def pids(self) -> set[int]: ...  # noqa: D102


class Counters(Protocol):
    """What reads the counters of nodes."""

    def read(self, now: float) -> list[Counted]: ...  # noqa: D102
    def called(self) -> list[Called]: ...  # noqa: D102
    def failures(self) -> list[Failure]: ...  # noqa: D102


class Taps(Protocol):
    """What subscribes itself."""

    def tallies(self, now: float, node_of: Callable[[str], str | None]) -> list[Tally]: ...  # noqa: D102
    def choose(self, graph: Graph) -> None: ...  # noqa: D102
    def failures(self) -> list[Failure]: ...  # noqa: D102
    def shed(self) -> int: ...  # noqa: D102


class Reports(Protocol):
    """The subscriptions to what nodes and monitors report about themselves."""

    parameters: Parameters

    def choose(self, graph: Graph) -> None: ...  # noqa: D102
    def take(self, now: float, node_of: Callable[[str], str | None]) -> Reported: ...  # noqa: D102


SWEEP_PER_S, QUIET_SWEEP_PER_S = 20, 4
"""How many topics are asked anew in a second: all of them in turn after each change of the graph, of which some are in
no list of what nodes have; and a few where nothing is known to have changed."""
PARAMETERS_S = 5.0
"""A graph of which only parameters changed is reported so often at most; each change is an event at once."""
CALLS_S = 1.0
"""Calls of services are reported so often."""
_GRACE_S = 60.0


class Observation:
    """One frame per period and one per change of the graph.

    Args:
        host: the name of this host.
        graphs: reads the graph.
        counters: reads what nodes count themselves.
        taps: own subscriptions; None without.
        reports: what nodes and monitors tell of themselves; None to leave that out.
    """

    def __init__(
        self, host: str, graphs: Graphs, counters: Counters, taps: Taps | None = None, reports: Reports | None = None
    ) -> None:
        self._host = host
        self._graphs = graphs
        self._counters = counters
        self._taps = taps
        self._reports = reports
        self._parameters_reported = float("-inf")
        self._changes = Changes()
        self._graph: Graph | None = None
        self._there: set[tuple[str, str]] = set()
        self._several: frozenset[tuple[str, str]] = frozenset()
        self._reported: set[Failure] = set()
        self._left: dict[str, tuple[str, float]] = {}
        self._domain = SameDomain()
        self._calls = CallTimes()
        self._calls_reported = float("-inf")
        self._to_sweep = 0

    @property
    def unsettled(self) -> bool:
        """Whether something was not known yet and must be asked again soon."""
        return self._graphs.unsettled

    def pids(self) -> set[int]:
        """Return the processes to watch."""
        return self._graphs.pids()

    def changed(self, now: float, with_process: tuple[int, str] = (0, "")) -> Frame | None:
        """Return the graph and what happened, at seconds since the epoch; None where nothing did.

        ``with_process`` is a process that has just ended, and how.
        """
        graph = self._graphs.update()
        # A round that had begun before is finished first.
        self._to_sweep = len({end.name for end in graph.endpoints}) + SWEEP_PER_S
        if self._reports is not None:
            self._reports.choose(graph)
            # New knowledge of parameters is no reason to report the whole at once.
            graph = msgspec.structs.replace(graph, parameters=self._graph.parameters if self._graph else {})
        if graph == self._graph:
            return None
        if self._reports is not None:
            graph = msgspec.structs.replace(graph, parameters=self._reports.parameters.known())
        self._remember_names(graph, now)
        self._domain.take(graph, now)
        self._graph = graph
        self._there = {(end.node, end.name) for end in graph.endpoints}
        self._several = several_publishers(graph)
        found = set(misfits(graph.endpoints))
        fresh = found - self._reported
        # What is mended and breaks again is reported again.
        self._reported = found
        if self._taps is not None:
            self._taps.choose(graph)
        return self._frame(
            now,
            events=self._changes.to(graph, now, with_process),
            graph=graph,
            failures=sorted(fresh, key=lambda one: one.what),
        )

    def ended(self, pid: int, now: float, how: str = UNKNOWN) -> Frame | None:
        """Return what the end of a process changes; ``how`` it ended is text of `model/acting/process_end.py`."""
        return self.changed(now, (pid, how)) if self._graphs.ended(pid) else None

    def period(self, now: float, seconds: float, *, attentive: bool = True) -> tuple[Frame, bool]:
        """Return what was counted since the last period, and whether the graph had changed unnoticed.

        Of who was not ``attentive`` all the time, taps lost messages that nobody else lost.
        """
        counted_here = [one for one in self._counters.read(now) if not self._graphs.own(one.gid) and self._here(one)]
        counted = joined(counted_here, self._name_of, self._host, self._several)
        self._calls.add(one for one in self._counters.called() if self._domain.has(one.tally.publisher, one.pid))
        tallies = [tally for tally in counted if tally.count or self._stands(tally)]
        failures = self._counters.failures()
        shed = 0
        if self._taps is not None:
            tapped = self._taps.tallies(now, self._name_of)
            tallies += tapped if attentive else []
            failures += self._taps.failures()
            shed = self._taps.shed()
        reported = self._listened(now)
        stale = self._graphs.sweep(self._share_of_sweep(seconds))
        frame = self._frame(
            now, tallies=tallies + reported.tallies, samples=self._called(now), failures=failures + reported.failures,
            shed=shed, events=reported.events, graph=self._with_parameters(now), looked=now if attentive else 0.0,
        )  # fmt: skip
        return frame, stale

    def _share_of_sweep(self, seconds: float) -> int:
        """Return how many topics are asked anew in so many seconds."""
        most = max(1, round((SWEEP_PER_S if self._to_sweep > 0 else QUIET_SWEEP_PER_S) * seconds))
        self._to_sweep -= most
        return most

    def ask(self, now: float) -> bool:
        """Ask nodes for their parameters; return whether that is to go on soon. ``now`` is of a clock without jumps."""
        if self._reports is None:
            return False
        self._reports.parameters.again(now)
        self._reports.parameters.turn(now)
        return self._reports.parameters.busy

    def _called(self, now: float) -> list[Sample]:
        """Return what is known of the services of this domain, once a second."""
        if 0 <= now - self._calls_reported < CALLS_S:
            return []
        self._calls_reported = now
        return self._calls.samples(now)

    def _listened(self, now: float) -> Reported:
        if self._reports is None:
            return Reported()
        return self._reports.take(now, self._name_of)

    def _with_parameters(self, now: float) -> Graph | None:
        """Return the graph again if parameters differ from those in it."""
        if self._reports is None or self._graph is None or not self._reports.parameters.news:
            return None
        if now - self._parameters_reported < PARAMETERS_S:
            return None
        self._parameters_reported = now
        self._graph = msgspec.structs.replace(self._graph, parameters=self._reports.parameters.known())
        return self._graph

    def _stands(self, tally: Tally) -> bool:
        """Return whether a connection still exists: the silence of a removed one is not worth reporting."""
        return all((name, tally.topic) in self._there for name in (tally.publisher, tally.subscriber) if name)

    def _here(self, one: Counted) -> bool:
        return self._domain.has(one.tally.subscriber or one.tally.publisher, one.pid)

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
