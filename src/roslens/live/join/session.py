"""One watch over a system: observers in, verdicts out. The clock is an argument here too."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Protocol, cast

import msgspec

from roslens.judge.reference.expectation import Reference
from roslens.judge.reference.unmatched import Subject
from roslens.live.join.counted_once import CountedOnce
from roslens.live.join.gid_names import GidNames
from roslens.live.join.graph_union import GraphUnion
from roslens.live.join.instances import several_publishers
from roslens.live.join.node_processes import NodeProcesses
from roslens.live.join.note import Note
from roslens.live.join.one_stretch import OneStretch
from roslens.live.join.seen import Seen
from roslens.live.join.service_calls import ServiceCalls
from roslens.live.join.waiting import Waiting
from roslens.live.rate.glance import Glance
from roslens.live.rate.monitor import Monitor
from roslens.live.system.halted import Halted
from roslens.live.system.tree import SystemView
from roslens.live.window.host_clocks import HostClocks
from roslens.live.window.observer_status import ObserverStatus
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Event, Graph
from roslens.model.traffic.tally import Tally
from roslens.model.verdict import State, Verdict
from roslens.model.wire import Frame

BEGIN_S = 60.0
"""How long to wait for observers that report nothing at all; then what was not observed counts as absent."""


class Source(Protocol):
    """An observer that is asked again and again."""

    def poll(self, seconds: float) -> Iterable[Frame | Failure]:
        """Wait at most so long, and return what came."""

    def close(self) -> None:
        """Stop observing."""


class ProcessWatcher(Protocol):
    """A source that samples processes, and learns which of them hold nodes."""

    def name(self, host: str, pids: frozenset[int]) -> None:
        """Watch these processes of a host."""


class HostFinder(Protocol):
    """A source that knows the addresses of hosts."""

    def hosts(self) -> Mapping[str, str]:
        """Return names of hosts by address."""


class Ending(Protocol):
    """A source that takes a while to end."""

    def end(self) -> None:
        """Begin to."""


class Beginner(Protocol):
    """A source that takes a while until it sees anything."""

    @property
    def seeing(self) -> bool:
        """Whether it does."""


class Step(msgspec.Struct, frozen=True):
    """What happened between two looks at the system.

    Attributes:
        time: of the look, in seconds on the monitor's clock.
        changes: verdicts whose state changed.
        causes: bad verdicts of which only the cause did.
        notes: what the watch tells of itself.
        events: changes of the graph.
        failures: what observers could not do.
        graph: what is there, where that changed; None where it did not.
        halted: nodes that are stopped or hang, where the reference has reactions; None where nobody asks.
        shed: records that observers dropped so far, before the monitor had them.
        begun: whether all observers see.
    """

    time: float
    changes: tuple[Verdict, ...] = ()
    events: tuple[Event, ...] = ()
    failures: tuple[Failure, ...] = ()
    causes: tuple[Verdict, ...] = ()
    notes: tuple[Note, ...] = ()
    graph: Graph | None = None
    halted: tuple[Halted, ...] | None = None
    shed: int = 0
    begun: bool = True


class Session:
    """Joins the reports of observers, and rates them.

    Attributes:
        begun: whether all observers see, so that who is not there is absent; :func:`run` finds out.
    """

    def __init__(self, reference: Reference, *, start: float) -> None:
        """Watch from ``start`` on.

        Raises:
            ValueError: a pattern of the reference is none.
        """
        self.monitor = Monitor(reference, start=start)
        self.records = 0
        self.begun = True
        self._processes = NodeProcesses()
        self._graphs = GraphUnion()
        self._seen = Seen()
        self._graph_changed = False
        self._whole: Graph | None = None
        self._clocks = HostClocks()
        self._names = GidNames()
        self._stretches = OneStretch()
        self._counted = CountedOnce()
        self._services = ServiceCalls()
        self._readers: dict[str, ObserverStatus] = {}
        self._now = self._start = start
        self._hosts: dict[str, str] = {}
        self._events: list[Event] = []
        self._failures: list[Failure] = []
        self._bad: dict[tuple[EntityId, str], State] = {}
        self._reported: set[tuple[str, str]] = set()
        self._pids: dict[str, frozenset[int]] = {}

    def name_processes(self, watchers: Iterable[ProcessWatcher]) -> None:
        """Inform the samplers of processes which of them contain nodes, if that has changed."""
        if not self._graph_changed:
            return
        pids: dict[str, set[int]] = {}
        for node in self._graphs.whole().nodes:
            if node.host and node.pid:
                pids.setdefault(node.host, set()).add(node.pid)
        for host, found in pids.items():
            known = frozenset(found)
            if self._pids.get(host) != known:
                self._pids[host] = known
                for watcher in watchers:
                    watcher.name(host, known)

    def know_hosts(self, hosts: Mapping[str, str]) -> None:
        """Take which host has which address."""
        self._graph_changed |= self._graphs.places.know(hosts)

    def wait_for(self, beginners: Sequence[Beginner], now: float) -> None:
        """Let the grace of entities that were not observed yet count from when all of these observe.

        A process that observes takes a second to start, and five on a busy machine: what it has not reported by then
        was not looked for.
        """
        self.monitor.begin(now)
        self.begun = now - self._start > BEGIN_S or all(one.seeing for one in beginners)

    def take(self, came: Iterable[Frame | Failure]) -> None:
        """Take the reports of observers."""
        for one in came:
            if isinstance(one, Failure):
                self._fail(one)
            else:
                self._frame(one)

    def look(self, now: float) -> Step:
        """Rate what came and return what is new."""
        self._now = now
        whole = self._graphs.whole() if self._graph_changed else None
        if whole is not None:
            self._whole = whole
            self._names.take_graph(whole, now)
            self._stretches.several = several_publishers(whole)
            self._hosts = {node.name: node.host for node in whole.nodes if node.host}
            self._processes.add_graph("", whole)
            self._seen.add_graph(whole)
            self.monitor.add_graph(whole, now)
            self._graph_changed = False
        self._add_counted(self._names.due(now))
        for sample in self._services.samples(now):
            if self._names.has(sample.entity.name):
                self.monitor.add_sample(sample)
        changes, causes = self._parted(self.monitor.tick(now))
        step = Step(
            now,
            changes,
            tuple(self._events),
            tuple(self._failures),
            causes,
            graph=whole,
            halted=tuple(sorted(self.monitor.world.halted(now))) if self.monitor.reacts else None,
            shed=self.monitor.shed,
            begun=self.begun,
        )
        self._events.clear()
        self._failures.clear()
        return step

    def rate(self, tallies: Iterable[Tally], observer_status: ObserverStatus | None = None) -> None:
        """Take traffic that is named, counted once and by one clock, and was reported by ``observer_status``."""
        self.monitor.add_tallies(tallies, observer_status)

    def readings(self, now: float) -> list[tuple[EntityId, dict[str, float]]]:
        """Return the latest values of every entity that has any, each entity once.

        What has ended, and is judged by nobody, has none: that it is silent says nothing any more.
        """
        found: dict[str, dict[str, float]] = {}
        waiting = [self.tree(now)]
        while waiting:
            part = waiting.pop()
            if part.values:
                found[part.id] = part.values
            waiting += part.children
        ended = self.monitor.world.ended()
        named = ((EntityId.parse(entity), values) for entity, values in sorted(found.items()))
        return [(entity, values) for entity, values in named if entity not in ended]

    def graph(self) -> Graph:
        """Return what is there now, as far as any observer knows."""
        if self._graph_changed or self._whole is None:
            return self._graphs.whole()
        return self._whole

    def seen(self) -> tuple[Subject, ...]:
        """Return everything that was there at any time since the watch began."""
        return self._seen.subjects(self.monitor.world)

    def tree(self, now: float) -> SystemView:
        """Return the system with its worst states and latest values."""
        return self.monitor.tree(now)

    def glance(self, now: float, looked_at: Collection[str]) -> Glance:
        """Return tree and verdicts, with values of the present of these topics and of what is not fine."""
        return self.monitor.glance(now, looked_at)

    def _parted(self, verdicts: Iterable[Verdict]) -> tuple[tuple[Verdict, ...], tuple[Verdict, ...]]:
        """Return verdicts whose state changed, and bad ones of which only the cause did."""
        changes, causes = [], []
        for one in verdicts:
            key = (one.entity, one.expectation)
            if self._bad.get(key) is one.state:
                causes.append(one)
                continue
            changes.append(one)
            if one.state.bad:
                self._bad[key] = one.state
            else:
                self._bad.pop(key, None)
        return tuple(changes), tuple(causes)

    def _frame(self, frame: Frame) -> None:
        self.records += len(frame.tallies) + len(frame.samples)
        mine = self._counted.accepts(frame.counted_at, frame.sender, self._now)
        observer_status = self.monitor.take_report(frame.sender, frame.vouched, of_graph=_of_graph(frame))
        if frame.counted_at:
            self._take_counted(frame.tallies if mine else (), observer_status)
        elif self._clocks.several:
            self.rate(map(self._by_one_clock, frame.tallies), observer_status)
        else:
            self.rate(frame.tallies, observer_status)
        if frame.graph is not None:
            self._graphs.put(frame.sender, frame.graph)
            self._graph_changed = True
        self._graph_changed |= self._graphs.places.happened(frame.events)
        self._take_samples(frame, observer_status, mine=mine)
        for event in frame.events:
            self.monitor.add_event(event)
        self._events += frame.events
        for failure in frame.failures:
            self._fail(failure)
        self.monitor.shed += max(frame.shed, 0)

    def _take_samples(self, frame: Frame, observer_status: ObserverStatus, *, mine: bool) -> None:
        """Take the samples of a frame; those of services only where what it counted is ``mine`` to take."""
        for sample in frame.samples:
            if sample.entity.kind is EntityKind.SERVICE:
                if mine:
                    self._services.put(frame.sender, sample, self._now)
                continue
            self._clocks.take(sample)
            self.monitor.add_sample(sample, observer_status)
            for of_node in self._processes.of(sample):
                self.monitor.add_sample(of_node, observer_status)

    def _take_counted(self, tallies: Iterable[Tally], observer_status: ObserverStatus) -> None:
        """Take what was read from counters without ROS: publishers may have no name, hosts other clocks."""
        named = []
        for tally in tallies:
            self._readers[tally.host] = observer_status
            named.append(self._names.named(tally, self._now))
        self._add_counted(tally for tally in named if tally is not None)

    def _add_counted(self, tallies: Iterable[Tally]) -> None:
        # Whose memory a count lies in is where it was received, whatever else bears the name.
        for tally in self._stretches.of(tallies):
            self.rate([self._by_one_clock(tally, tally.host)], self._readers.get(tally.host))

    def _by_one_clock(self, tally: Tally, receiver: str = "") -> Tally:
        sender = self._hosts.get(tally.publisher, "")
        receiver = receiver or self._hosts.get(tally.subscriber, "") or tally.host
        return self._clocks.corrected(tally, sender, receiver, self.monitor.tolerance(tally))

    def _fail(self, failure: Failure) -> None:
        """Keep a failure; what is said again and again is reported once."""
        key = (failure.tool, str(failure))
        if key not in self._reported:
            self._reported.add(key)
            self._failures.append(failure)
            self.monitor.failures.append(failure)


def _of_graph(frame: Frame) -> bool:
    """Whether a frame contains a graph: agents only report a host and its processes."""
    return frame.graph is not None and bool(frame.graph.nodes or frame.graph.endpoints)


def run(
    session: Session,
    sources: Sequence[Source],
    *,
    wall: Callable[[], float],
    stopped: Callable[[float], bool],
    report: Callable[[Step], None],
    longest_wait_s: float = 0.1,
) -> None:
    """Watch until ``stopped`` returns true, and report each step.

    The sources are closed at the end, whatever happens.
    """
    watchers = [cast("ProcessWatcher", source) for source in sources if hasattr(source, "name")]
    finders = [cast("HostFinder", source) for source in sources if hasattr(source, "hosts")]
    beginners = [cast("Beginner", source) for source in sources if hasattr(source, "seeing")]
    waiting = Waiting(sources, longest_wait_s)
    session.begun = not beginners
    try:
        while not stopped(wall()):
            share = waiting.wait()
            for source in sources:
                session.take(source.poll(share))
            for finder in finders:
                session.know_hosts(finder.hosts())
            session.name_processes(watchers)
            if not session.begun:
                session.wait_for(beginners, wall())
            report(session.look(wall()))
    finally:
        # All are asked before one is waited for: each may take seconds to leave its system in order.
        for source in sources:
            if hasattr(source, "end"):
                cast("Ending", source).end()
        for source in sources:
            source.close()
