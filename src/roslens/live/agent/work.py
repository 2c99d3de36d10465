"""The agent at work: sample, send, answer; on a thread of its own or as a program."""

from __future__ import annotations

import contextlib
import select
import socket
import time
from collections.abc import Callable, Iterable, Mapping

import msgspec

from roslens.live.agent.clock_offset import ClockOffset
from roslens.live.agent.counting import Counters, with_nodes
from roslens.live.agent.host import HostSampler
from roslens.live.agent.link import Channel, LinkError, Outbox, asked_time, read_pids, read_times
from roslens.live.agent.processes import ProcessSampler
from roslens.model.failure import Failure
from roslens.model.graph import Event, Graph
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Tally
from roslens.model.wire import VERSION, Frame

SHORTEST_WAIT_S, LONGEST_WAIT_S = 0.5, 10.0
FIND_EVERY_S = 2.0
ASK_TIME_EVERY_S = 0.5
COUNT_EVERY_S = 0.15
"""An alarm may come 0.2 s after its window: counting, the line and the monitor share that."""
COUNT_SHARE = 0.01
"""Nodes of many processes are counted less often, so that it takes no more than this share of a core. Its CPU time
counts: where others keep the host busy, that an agent waits for its turn is no reason to tell late besides."""
COUNT_AT_LEAST_EVERY_S = 1.0
_PIECE = 65_536


class Agent:
    """Samples a host and sends what it sees; the line may come and go."""

    def __init__(
        self,
        name: str,
        host: HostSampler,
        processes: ProcessSampler,
        *,
        address: tuple[str, int],
        key: bytes,
        wall: Callable[[], float],
        steady: Callable[[], float],
        period_s: float = 1.0,
        say: Callable[[str], None] = lambda _: None,
        counters: Counters | None = None,
        identities: Callable[[], tuple[str, ...]] = tuple,
        spent: Callable[[], float] = time.thread_time,
        seen: Callable[[Mapping[int, Iterable[str]]], None] = lambda _: None,
    ) -> None:
        """Work for the monitor at ``address``; ``wall`` is the clock of the host, ``steady`` one that never jumps.

        ``counters`` reads what the nodes of the host count, ``identities`` is what identifiers made here begin with,
        ``spent`` the CPU time that the agent has taken. ``seen`` learns which processes hold nodes, and which
        of these count there.

        Raises:
            LinkError: the key is too short.
        """
        Channel(key, accepting=False)
        self._name = name
        self._host = host
        self._processes = processes
        self._address = address
        self._key = key
        self._wall = wall
        self._steady = steady
        self._period_s = period_s
        self._say = say
        self._counters = counters
        self._identities = identities
        self._spent = spent
        self._seen = seen
        self._outbox = Outbox()
        self._offset = ClockOffset()
        self._sequence = 0
        self._socket: socket.socket | None = None
        self._channel: Channel | None = None
        self._sending = bytearray()
        self._wait_s = SHORTEST_WAIT_S
        self._due = {"sample": 0.0, "find": 0.0, "connect": 0.0, "time": 0.0, "count": 0.0}
        self._count_every_s = COUNT_EVERY_S
        self._graph_reported: Graph | None = None
        self._named: frozenset[int] = frozenset()
        self._reason = ""

    def run(self, stopped: Callable[[], bool]) -> None:
        """Work until ``stopped`` returns true; it is called at least once in a period."""
        try:
            while not stopped():
                self.step()
        finally:
            self.close()

    def step(self) -> None:
        """Do what is due, then wait for the next thing to happen."""
        now = self._steady()
        if self._is_due("find", now, FIND_EVERY_S):
            self._tell(events=self._processes.find(self._wall()))
        if self._counters is not None and self._is_due("count", now, self._count_every_s):
            self._count(self._counters)
        if self._is_due("sample", now, self._period_s):
            self._take_sample()
        if self._socket is None and now >= self._due["connect"]:
            self._connect(now)
        if self._channel is not None and self._channel.ready:
            self._fill(self._channel, now)
        self._wait(max(self._next_due() - self._steady(), 0.0))

    def _take_sample(self) -> None:
        wall = self._wall()
        samples = [self._with_clock(self._host.sample(wall)), *self._processes.sample(wall)]
        self._tell(samples=samples, graph=self._graph())
        for place, calls in self._counters.calls(wall) if self._counters is not None else ():
            self._tell(samples=calls, counted_at=place)

    def _fill(self, channel: Channel, now: float) -> None:
        """Put into the line what it can take: a question for the time where it is due, and one frame."""
        if self._is_due("time", now, ASK_TIME_EVERY_S):
            self._sending += channel.message("T", asked_time(self._wall()))
        while not self._sending and (body := self._outbox.take()) is not None:
            self._sending += channel.message("F", body)

    def _next_due(self) -> float:
        """Return when there is something to do again, whatever comes in."""
        dues = ["sample", "find"]
        dues += ["time"] if self._channel is not None and self._channel.ready else []
        dues += ["count"] if self._counters is not None else []
        return min(self._due[one] for one in dues)

    def close(self) -> None:
        """Let the line and all files go."""
        self._hang_up("")
        self._host.close()
        self._processes.close()
        if self._counters is not None:
            self._counters.close()

    def _is_due(self, what: str, now: float, every_s: float) -> bool:
        if now < self._due[what]:
            return False
        # After a standstill the missed turns are not made up for.
        late = now - self._due[what]
        self._due[what] = now + every_s - (late if late < every_s else 0.0)
        return True

    def _with_clock(self, sample: Sample) -> Sample:
        offset = self._offset.now()
        if offset is None:
            return sample
        values = {**sample.values, "clock_offset": offset.ahead, "clock_bound": offset.bound}
        return msgspec.structs.replace(sample, values=values)

    def _count(self, counters: Counters) -> None:
        """Report the counters of nodes, for each place in a frame of its own."""
        wall, begun = self._wall(), self._spent()
        for place, tallies in counters.read(wall):
            if tallies:
                self._tell(tallies=tallies, counted_at=place)
        # With this all of it is reported: what is in none of these frames was silent until now.
        self._tell(looked=wall)
        took = self._spent() - begun
        self._count_every_s = min(max(COUNT_EVERY_S, took / COUNT_SHARE), COUNT_AT_LEAST_EVERY_S)

    def _graph(self) -> Graph:
        processes = self._processes.processes()
        if self._counters is not None:
            nodes = self._counters.nodes()
            named = frozenset(nodes) | self._named
            self._processes.name(named)
            processes = with_nodes(processes, nodes)
        self._seen({one.pid: one.nodes for one in processes})
        identities = self._identities()
        return Graph(
            "", hosts=(self._name,), processes=processes, identities={self._name: identities} if identities else {}
        )

    def _tell(
        self,
        samples: Iterable[Sample] = (),
        events: Iterable[Event] = (),
        tallies: Iterable[Tally] = (),
        graph: Graph | None = None,
        counted_at: str = "",
        looked: float = 0.0,
    ) -> None:
        samples, events, tallies = list(samples), list(events), list(tallies)
        if not samples and not events and not tallies and not looked:
            return
        if graph is None and (events or self._graph_reported is None):
            graph = self._graph()
        elif graph == self._graph_reported:
            graph = None
        self._graph_reported = graph or self._graph_reported
        failures: list[Failure] = self._counters.failures() if self._counters is not None else []
        frame = Frame(
            VERSION, f"{self._name}/agent", self._sequence, self._wall(), tallies, samples, events, graph, failures,
            counted_at=counted_at, looked=looked,
        )  # fmt: skip
        self._outbox.put(frame)
        self._sequence += 1

    def _connect(self, now: float) -> None:
        self._due["connect"] = now + self._wait_s
        self._wait_s = min(self._wait_s * 2, LONGEST_WAIT_S)
        try:
            found = socket.getaddrinfo(*self._address, type=socket.SOCK_STREAM)[0]
            self._socket = socket.socket(found[0], socket.SOCK_STREAM)
            self._socket.settimeout(LONGEST_WAIT_S / 5)
            self._socket.connect(found[4])
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._socket.setblocking(False)
        except OSError as error:
            self._hang_up(f"no line to {self._address[0]}:{self._address[1]}: {error.strerror or error}; trying again")
            return
        self._channel = Channel(self._key, accepting=False)
        self._sending = bytearray(self._channel.hello())

    def _hang_up(self, reason: str) -> None:
        if self._socket is not None:
            self._socket.close()
        self._socket, self._channel = None, None
        self._sending.clear()
        self._graph_reported = None
        if reason and reason != self._reason:
            self._say(reason)
        self._reason = reason

    def _wait(self, seconds: float) -> None:
        handles = self._processes.handles()
        reading: list[int | socket.socket] = [*handles]
        writing = []
        if self._socket is not None:
            reading.append(self._socket)
            if self._sending:
                writing.append(self._socket)
        readable, writable, _ = select.select(reading, writing, [], min(seconds, self._period_s))
        for one in readable:
            if isinstance(one, int):
                event = self._processes.ended(handles[one], self._wall())
                self._tell(events=[event] if event is not None else [])
        if self._socket is not None and self._socket in readable:
            self._receive(self._socket)
        if self._socket is not None and self._socket in writable:
            self._send(self._socket)

    def _receive(self, line: socket.socket) -> None:
        try:
            piece = line.recv(_PIECE)
        except BlockingIOError:
            return
        except OSError as error:
            self._hang_up(f"the line broke: {error.strerror or error}; trying again")
            return
        if not piece or self._channel is None:
            proven = self._channel is not None and self._channel.ready
            why = "" if proven else " before it knew the key: give both the same --key-file"
            self._hang_up(f"the monitor hung up{why}; trying again")
            return
        try:
            for letter, body in self._channel.feed(piece):
                self._answer(letter, body)
        except LinkError as error:
            self._hang_up(str(error))

    def _answer(self, letter: str, body: bytes) -> None:
        if letter == "send":
            self._sending += body
        elif letter == "ready":
            self._wait_s = SHORTEST_WAIT_S
            self._graph_reported = None
            self._say(f"connected to {self._address[0]}:{self._address[1]}")
            self._reason = "connected"
        elif letter == "t":
            self._offset.add(*read_times(body), self._wall())
        elif letter == "P":
            self._named = frozenset(read_pids(body))
            self._processes.name(self._named)

    def _send(self, line: socket.socket) -> None:
        try:
            sent = line.send(self._sending)
        except BlockingIOError:
            return
        except OSError as error:
            self._hang_up(f"the line broke: {error.strerror or error}; trying again")
            return
        with contextlib.suppress(IndexError):
            del self._sending[:sent]
