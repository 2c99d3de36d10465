"""The host on which the monitor itself runs, sampled without an agent."""

from __future__ import annotations

import select
from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

import msgspec

from roslens.live.agent.counting import with_nodes
from roslens.live.agent.host import HostSampler
from roslens.live.agent.processes import ProcessSampler
from roslens.model.failure import Failure
from roslens.model.graph import Event, Graph
from roslens.model.traffic.sample import Sample
from roslens.model.wire import VERSION, Frame


class WhoCounts(Protocol):
    """Finds out who counts on this host, and where."""

    def look(self, now: float) -> None:
        """Look again; ``now`` is seconds since the epoch."""

    def nodes(self) -> Mapping[int, frozenset[str]]:
        """Return who counts in which process, by the id that the process sees itself."""

    def places(self) -> list[str]:
        """Return where is counted."""

    def failures(self) -> list[Failure]:
        """Return what went wrong since this was last asked."""

    def close(self) -> None:
        """Let go of everything."""


def _own_clock(sample: Sample) -> Sample:
    return msgspec.structs.replace(sample, values={**sample.values, "clock_offset": 0.0, "clock_bound": 0.0})


class LocalHost:
    """A source of frames like an agent's, from this host."""

    def __init__(
        self,
        name: str,
        host: HostSampler,
        processes: ProcessSampler,
        *,
        wall: Callable[[], float],
        steady: Callable[[], float],
        period_s: float = 1.0,
        counters: WhoCounts | None = None,
        identities: Callable[[], tuple[str, ...]] = tuple,
    ) -> None:
        """Sample the host ``name`` every ``period_s`` seconds, and look for its processes every second sample.

        Of ``counters`` only who counts is reported here: an observer of ROS beside the monitor tells what is counted in
        its domain, so that nobody else has to. ``identities`` is what identifiers made here begin with.
        """
        self._name = name
        self._host = host
        self._processes = processes
        self._wall = wall
        self._steady = steady
        self._period_s = period_s
        self._counters = counters
        self._identities = identities
        self._due = 0.0
        self._sequence = 0
        self._samples = 0
        self._graph_reported: Graph | None = None

    def poll(self, seconds: float = 0.0) -> list[Frame]:
        """Return a frame where one is due, or where a process ended; waits for nothing but that."""
        events = self._ended(seconds)
        samples: list[Sample] = []
        frames: list[Frame] = []
        if self._is_due():
            wall = self._wall()
            # Frames are no measure of it: there are more of them where counters are read or a process ended.
            if self._samples % 2 == 0:
                events += self._processes.find(wall)
            self._samples += 1
            samples = [_own_clock(self._host.sample(wall)), *self._processes.sample(wall)]
            if self._counters is not None:
                frames = self._counted(self._counters, wall)
        if not events and not samples:
            return []
        return [self._frame(samples, events, self._news()), *frames]

    def _ended(self, seconds: float) -> list[Event]:
        """Wait so long for processes to end; return those that did."""
        handles = self._processes.handles()
        if not handles:
            return []
        readable = select.select([*handles], [], [], seconds)[0]
        ended = [self._processes.ended(handles[handle], self._wall()) for handle in readable]
        return [one for one in ended if one is not None]

    def _is_due(self) -> bool:
        now = self._steady()
        if now < self._due:
            return False
        late = now - self._due
        self._due = now + self._period_s - (late if late < self._period_s else 0.0)
        return True

    def _news(self) -> Graph | None:
        """Return the graph where it is not as it was last reported: everybody who takes it works through all of it."""
        graph = self._graph()
        if graph == self._graph_reported:
            return None
        self._graph_reported = graph
        return graph

    def _graph(self) -> Graph:
        identities = self._identities()
        nodes = self._counters.nodes() if self._counters is not None else {}
        return Graph(
            "",
            hosts=(self._name,),
            processes=with_nodes(self._processes.processes(), nodes),
            identities={self._name: identities} if identities else {},
        )

    def _counted(self, counters: WhoCounts, wall: float) -> list[Frame]:
        """Return a frame for each place with counters, which at least shows that it is reported from here."""
        counters.look(wall)
        failures = counters.failures()
        return [self._frame([], counted_at=place, failures=failures) for place in counters.places()]

    def _frame(
        self, samples: list[Sample], events: Sequence[Event] = (), graph: Graph | None = None, counted_at: str = "",
        failures: Sequence[Failure] = (),
    ) -> Frame:  # fmt: skip
        self._sequence += 1
        return Frame(
            VERSION, f"{self._name}/monitor", self._sequence, self._wall(), [], samples, list(events), graph,
            list(failures), counted_at=counted_at,
        )  # fmt: skip

    def descriptors(self) -> list[int]:
        """Return what becomes readable when a process ends."""
        return list(self._processes.handles())

    def name(self, host: str, pids: frozenset[int]) -> None:
        """Watch these processes too, if it is of this host that they are said to be."""
        if host == self._name:
            self._processes.name(pids)

    def close(self) -> None:
        """Let all files go."""
        self._host.close()
        self._processes.close()
        if self._counters is not None:
            self._counters.close()
