"""The host on which the monitor itself runs, sampled without an agent."""

from __future__ import annotations

import select
from collections.abc import Callable

import msgspec

from roslens.live.agent.host import HostSampler
from roslens.live.agent.processes import ProcessSampler
from roslens.model.graph import Graph
from roslens.model.sample import Sample
from roslens.model.wire import VERSION, Frame


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
    ) -> None:
        """Sample the host ``name`` every ``period_s`` seconds, and look for its processes every second sample."""
        self._name = name
        self._host = host
        self._processes = processes
        self._wall = wall
        self._steady = steady
        self._period_s = period_s
        self._due = 0.0
        self._sequence = 0

    def poll(self, seconds: float = 0.0) -> list[Frame]:
        """Return a frame where one is due, or where a process ended; waits for nothing but that."""
        events = []
        handles = self._processes.handles()
        if handles:
            for handle in select.select([*handles], [], [], seconds)[0]:
                ended = self._processes.ended(handles[handle], self._wall())
                events += [ended] if ended is not None else []
        now = self._steady()
        samples = []
        if now >= self._due:
            late = now - self._due
            self._due = now + self._period_s - (late if late < self._period_s else 0.0)
            wall = self._wall()
            if self._sequence % 2 == 0:
                events += self._processes.find(wall)
            samples = [_own_clock(self._host.sample(wall)), *self._processes.sample(wall)]
        if not events and not samples:
            return []
        graph = Graph("", hosts=(self._name,), processes=self._processes.processes())
        self._sequence += 1
        frame = Frame(VERSION, f"{self._name}/monitor", self._sequence, self._wall(), [], samples, events, graph)
        return [frame]

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
