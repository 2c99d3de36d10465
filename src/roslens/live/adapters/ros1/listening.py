"""Connections to publishers, all read by one thread: for the tap, within its budget, statistics and diagnostics."""

from __future__ import annotations

import os
import selectors
import socket
import threading
import time
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor

import msgspec

from roslens.live.adapters.ros1.budget import Budget, Limits
from roslens.live.adapters.ros1.names import TOOL
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.slave import Slave
from roslens.live.adapters.ros1.wire.stream import Source, Stream, Use
from roslens.live.adapters.ros1.wire.tcpros import Handshake, TcprosError, connect
from roslens.live.adapters.ros1.wire.xml_rpc import CallError
from roslens.live.reported.attention import Attention
from roslens.model.failure import Failure
from roslens.model.traffic.tally import Tally

MOST_STREAMS = 500
LONGEST_RETRY_S = 16.0
_IDLE_S = 0.25
_SETTLE_S = 0.05
"""Accounts are settled so often, since settling costs as much as a message."""
_MUCH = 1_000_000
"""Bytes after which they are settled anyway."""
_AT_ONCE = 4
EXPECTED = {
    Use.TAP: "messages",
    Use.STATISTICS: "rosgraph_msgs/TopicStatistics",
    Use.REPORTS: "diagnostic_msgs/DiagnosticArray of at most 1,000,000 bytes",
}
"""What is expected of who is listened to."""


class Taken(msgspec.Struct):
    """What came since the last time; ``attentive`` is whether it was read when it came."""

    tallies: list[Tally] = []
    failures: list[Failure] = []
    shed: int = 0
    reports: list[tuple[str, float, bytes]] = []
    attentive: bool = True


class _Attempt(msgspec.Struct):
    """How opening a source goes."""

    running: bool = False
    failed: int = 0
    next: float = 0.0


class Listening:
    """Reads what it is wanted to read.

    A reader that rests must not hold its connections: a publisher whose peer does not read waits for it. So they are
    closed while the budget is spent, and opened again.

    Args:
        caller: our own name.
        resolver: of hosts.
        clock: seconds since the epoch.
        host: on which we stand.
        limits: of the tap.
        wait_s: the longest that opening may take.
        news: called in another thread when nodes reported on themselves, once until that is taken.
    """

    def __init__(
        self,
        caller: str,
        resolver: Resolver,
        clock: Callable[[], float],
        host: str,
        limits: Limits | None = None,
        wait_s: float = 1.0,
        news: Callable[[], None] = lambda: None,
    ) -> None:
        self._caller = caller
        self._resolver = resolver
        self._clock = clock
        self._host = host
        self._wait_s = wait_s
        self._tell = news
        self._untaken = False
        self._lock = threading.Lock()
        self._attention = Attention(time.monotonic())
        self._budget = Budget(limits or Limits(), time.monotonic())
        self._streams: dict[Source, Stream] = {}
        self._attempts: dict[Source, _Attempt] = {}
        self._wanted: frozenset[Source] = frozenset()
        self._done = Taken()
        self._selector = selectors.DefaultSelector()
        self._wake = os.eventfd(0, os.EFD_NONBLOCK)
        self._selector.register(self._wake, selectors.EVENT_READ)
        self._open = True
        self._pool = ThreadPoolExecutor(_AT_ONCE, "open")
        self._thread = threading.Thread(target=self._run, daemon=True, name="listen")
        self._thread.start()

    def want(self, sources: Iterable[Source]) -> None:
        """Read these from now on and no others."""
        wanted = sorted(set(sources))
        now = time.monotonic()
        with self._lock:
            if len(wanted) > MOST_STREAMS:
                what = f"{len(wanted):,} connections are to be read, and only {MOST_STREAMS} are"
                self._fail(what, "fewer", "Narrow the patterns of the tap", "")
            self._wanted = frozenset(wanted[:MOST_STREAMS])
            for source in [source for source in self._streams if source not in self._wanted]:
                self._drop(source)
            self._attempts = {source: a for source, a in self._attempts.items() if source in self._wanted}
            for source in sorted(self._wanted - self._streams.keys()):
                attempt = self._attempts.setdefault(source, _Attempt())
                rests = source.use is Use.TAP and self._budget.paused
                if not attempt.running and now >= attempt.next and not rests:
                    attempt.running = True
                    self._pool.submit(self._start, source)

    def take(self) -> Taken:
        """Return what came since the last time."""
        with self._lock:
            taken, self._done = self._done, Taken()
            self._untaken = False
            now = self._clock()
            for source in sorted(self._streams):
                stream = self._streams[source]
                tallies, shed = stream.take(now)
                taken.tallies += tallies
                taken.shed += shed
                taken.reports += [(source.publisher, *report) for report in stream.reports()]
                if stream.problem:
                    self._fail(stream.problem, EXPECTED[source.use], "", source.publisher)
                    stream.problem = ""
            taken.failures += self._done.failures
            self._done = Taken()
            taken.attentive = self._attention.there(time.monotonic())
            if self._budget.paused:
                taken.shed += sum(1 for source in self._wanted if source.use is Use.TAP)
            return taken

    def close(self) -> None:
        """Hang up everywhere."""
        self._pool.shutdown(wait=True, cancel_futures=True)
        with self._lock:
            self._open = False
        os.eventfd_write(self._wake, 1)
        self._thread.join()
        with self._lock:
            for source in list(self._streams):
                self._drop(source)
            self._selector.close()
            os.close(self._wake)

    def _start(self, source: Source) -> None:
        """Open a source, in a thread of the pool."""
        problem = ""
        slave = Slave(source.uri, self._caller, self._resolver, self._wait_s)
        try:
            host, port = slave.request(source.topic)
            line, handshake = connect(self._resolver.address(host), port, source.topic, self._caller, self._wait_s)
        except (CallError, TcprosError, OSError) as error:
            problem = str(error)
        else:
            self._add(source, line, handshake)
        finally:
            slave.close()
        with self._lock:
            attempt = self._attempts.get(source)
            if attempt:
                attempt.running = False
                attempt.failed = attempt.failed + 1 if problem else 0
                attempt.next = time.monotonic() + min(2.0**attempt.failed / 2, LONGEST_RETRY_S)
            if problem and attempt and attempt.failed == 1:
                what = f"{source.topic} cannot be read from {source.publisher}: {problem}"
                self._fail(what, "a publisher that sends", "It is tried again, less and less often", source.publisher)

    def _add(self, source: Source, line: socket.socket, handshake: Handshake) -> None:
        with self._lock:
            rests = source.use is Use.TAP and self._budget.paused
            if not self._open or rests or source not in self._wanted or source in self._streams:
                line.close()
                return
            self._streams[source] = Stream(source, line, handshake, self._clock(), self._host)
            self._selector.register(line, selectors.EVENT_READ, source)
        os.eventfd_write(self._wake, 1)

    def _drop(self, source: Source) -> None:
        stream = self._streams.pop(source)
        tallies, shed = stream.take(self._clock())
        self._done.tallies += tallies
        self._done.shed += shed
        self._selector.unregister(stream.line)
        stream.line.close()

    def _fail(self, what: str, expected: str, advice: str, node: str) -> None:
        entity = f"node:{node}" if node else ""
        self._done.failures.append(Failure(TOOL, what, expected, advice, entity=entity, partial=True))

    def _run(self) -> None:
        cpu, due = time.thread_time(), 0.0
        messages = size = 0
        while self._open:
            ready = self._selector.select(_IDLE_S)
            with self._lock:
                self._attention.turn(time.monotonic())
                for key, _ in ready:
                    if key.data is None:
                        os.eventfd_read(self._wake)
                    elif key.data in self._streams:
                        found = self._drain(key.data)
                        messages += found[0]
                        size += found[1]
                if size > _MUCH or time.monotonic() >= due:
                    now, before = time.thread_time(), cpu
                    self._spend(now - before, messages, size)
                    cpu, due = now, time.monotonic() + _SETTLE_S
                    messages = size = 0

    def _drain(self, source: Source) -> tuple[int, int]:
        stream = self._streams[source]
        try:
            found = stream.drain(self._clock)
        except TcprosError as error:
            self._fail(f"{source.topic} of {source.publisher}: {error}", "a stream of messages", "", source.publisher)
            self._drop(source)
            return 0, 0
        if found.messages and source.use is Use.STATISTICS and not self._untaken:
            self._untaken = True
            self._tell()
        if not found.open:
            self._drop(source)
        return (found.messages, found.bytes) if source.use is Use.TAP else (0, 0)

    def _spend(self, cpu: float, messages: int, size: int) -> None:
        rested = self._budget.paused
        if self._budget.spend(cpu, messages, size, time.monotonic()) and not rested:
            for source in [source for source in self._streams if source.use is Use.TAP]:
                self._drop(source)
            advice = "It resumes when the budget permits; narrow its patterns, or raise --tap-budget"
            self._fail(f"the tap rests: it used {self._budget.why}", "topics that fit the budget", advice, "")
