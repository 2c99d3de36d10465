"""The monitor: takes the reports of observers, rates them against a reference, and reports what changed."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import chain

from roslens.judge.reference.expectation import Reference
from roslens.live.explain.explained import Explained
from roslens.live.rate.checks import Checks
from roslens.live.rate.evaluator import Evaluator
from roslens.live.rate.existence import Existence, named_by
from roslens.live.rate.glance import Glance, Glances
from roslens.live.rate.observer_watch import ObserverWatch
from roslens.live.rate.plans import plan, required, tolerance
from roslens.live.standing.measured import Measured
from roslens.live.standing.rulebook import NOTHING_KNOWN, Rulebook
from roslens.live.standing.standing import Standing
from roslens.live.system.connection import Connection
from roslens.live.system.sampled import Sampled, finite
from roslens.live.system.tree import SystemView
from roslens.live.system.world import World
from roslens.live.window.clock_watch import ClockWatch, Course
from roslens.live.window.observer_status import ObserverStatus
from roslens.live.window.plausible_tally import plausible_tally
from roslens.model.entity import EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Change, Event, Graph
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Tally
from roslens.model.traffic.tally_columns import TallyColumns, row_of, tally_of
from roslens.model.verdict import State, Verdict
from roslens.model.wire import Frame

_SWEEP_S = 30.0
_KEPT_FAILURES = 100
_SAMPLED = (EntityKind.HOST, EntityKind.NODE, EntityKind.PROCESS, EntityKind.SERVICE)


class Monitor:
    """Rates a live system or a recording of one; every time is an argument, in seconds on the monitor's clock.

    Attributes:
        shed: records that observers dropped before they reached the monitor.
        failures: the latest things that observers could not do.
        reacts: whether the reference has reactions.
    """

    def __init__(self, reference: Reference, *, start: float) -> None:
        """Begin to watch at ``start``; a pattern of the reference that is none is a ``ValueError``."""
        self._world = World()
        self._glances = Glances(self._world)
        self._clock = ClockWatch(start)
        self._began = start
        self._held = self._settling = False
        self._rules = Rulebook(reference)
        self.reacts = bool(reference.reactions)
        self._checks = Checks(self._rules, self._world, start)
        self._existence = Existence(self._world, self._checks.presences)
        self._explained = Explained(self._world, self._existence.gone_nodes)
        self._evaluator = Evaluator(self._world, self._existence, self._plan)
        self._observers = ObserverWatch(self._world, self._evaluator, start)
        self._moved: list[Standing] = []
        self._retired: list[Verdict] = []
        self._sweep_due = start
        self._implausible = 0
        self._known: dict[str, Connection] = {}
        self.shed = 0
        self.failures: deque[Failure] = deque(maxlen=_KEPT_FAILURES)
        self._evaluator.wait_all(required(self._world, self._rules, start))

    @property
    def world(self) -> World:
        """Everything that is known now."""
        return self._world

    @property
    def reference(self) -> Reference:
        """What is expected now."""
        return self._rules.reference

    @property
    def refused(self) -> int:
        """Records that could not be true, in whole or in part, and those for which there was no room."""
        return self._implausible + self._world.refused

    def take_report(self, sender: str, looked: float = 0.0, *, of_graph: bool = False) -> ObserverStatus:
        """Note that an observer reported; return its status, which is passed along with its reports.

        Args:
            sender: how it calls itself, ``<host>/<what it observes>``.
            looked: up to when it has looked, on its own clock; 0 where it does not say.
            of_graph: whether it tells who is there.
        """
        return self._observers.take_report(sender, looked, self._clock.now, of_graph=of_graph)

    def add_tally(self, tally: Tally, observer_status: ObserverStatus | None = None) -> None:
        """Take the traffic of a connection; what cannot be true of it is unknown.

        What no ``observer_status`` tells is observed as long as the monitor looks.
        """
        connection = self._world.connections.get((tally.topic, tally.publisher, tally.subscriber))
        if connection is not None:
            envelope, evaluator = connection.envelope, self._evaluator
            if envelope is not None and envelope.takes(row_of(tally), evaluator.round):
                evaluator.received = True
                return
        self._add(tally, connection, observer_status)

    def add_tallies(self, tallies: Iterable[Tally], observer_status: ObserverStatus | None = None) -> None:
        """Take the traffic of many connections; what comes by columns is not made into records without need."""
        if not isinstance(tallies, TallyColumns):
            for tally in tallies:
                self.add_tally(tally, observer_status)
            return
        evaluator, received, known = self._evaluator, False, self._known
        now = evaluator.round
        for names, connection, row in zip(tallies.names, map(known.get, tallies.names), tallies.rows(), strict=False):
            envelope = connection.envelope if connection is not None else None
            if envelope is not None and envelope.takes(row, now):
                received = True
                continue
            tally = tally_of(names, row)
            key = (tally.topic, tally.publisher, tally.subscriber)
            self._add(tally, connection or self._world.connections.get(key), observer_status)
            if connection is None and key in self._world.connections:
                known[names] = self._world.connections[key]
        evaluator.received |= received

    def _add(self, tally: Tally, connection: Connection | None, observer_status: ObserverStatus | None) -> None:
        # What has no name cannot be distinguished, nor shown.
        kept = plausible_tally(tally) if tally.topic else None
        if kept is not tally:
            self._implausible += 1
            if kept is None:
                return
        now = self._clock.now
        if connection is None:
            connection = self._existence.meet(kept, now)
            if connection is None:
                return
        if connection.add(kept, now, observer_status):
            if self._held and kept.count:
                self.clock_runs(now)
            self._evaluator.wait(connection)

    def add_sample(self, sample: Sample, observer_status: ObserverStatus | None = None) -> None:
        """Take what was read of a host, process, node or service; values that are not finite are unknown."""
        if sample.time - sample.time != 0 or sample.entity.kind not in _SAMPLED or not sample.entity.name:
            self._implausible += 1
            return
        sampled = self._world.entity(sample.entity, self._clock.now)
        if sampled is None:
            return
        values = finite(sample.values)
        self._implausible += len(values) < len(sample.values)
        if not sampled.seen:
            sampled.appeared = max(sampled.appeared, self._clock.now)
            sampled.planless = True
            self._existence.know(sampled)
        sampled.observer_status = observer_status
        stopped = sampled.newest("stopped")
        if sampled.add(sample, values):
            self._explained.stale |= bool(stopped) is not bool(sampled.newest("stopped"))
            self._existence.take_sample(sampled, sample.time)
            self._evaluator.wait(sampled)

    def add_graph(self, graph: Graph, time: float) -> None:
        """Take the whole graph as it is at ``time``."""
        now = self._clock.now
        for entity in self._world.take_graph(graph, now):
            entity.planless = True
            self._evaluator.wait(entity)
        self._existence.take_graph(graph, time, now)
        self._checks.states.take(graph, now)
        self._checks.twins.take(graph, now)
        self._explained.stale = True

    def add_event(self, event: Event) -> None:
        """Take a change of the graph: what appeared has grace, what vanished is gone at once."""
        entity = named_by(event)
        if entity is None:
            self._implausible += 1
            return
        key = (entity.kind, entity.name)
        if event.change is Change.VANISHED:
            self._existence.vanished_by(event, entity)
        elif event.change in (Change.APPEARED, Change.RESTARTED):
            self._existence.appear(key, self._checks.presences.existing.get(key, NOTHING_KNOWN))
            for one in self._world.concerned(entity):
                one.appeared = max(one.appeared, min(event.time, self._clock.now + 1))
                if isinstance(one, Connection) and one.publisher == entity.name:
                    # That it was away is no gap of what it publishes from now on.
                    one.clear(one.appeared)
                self._evaluator.wait(one)
        self._explained.stale = True

    def add_field(self, topic: str, time: float, values: Mapping[str, float]) -> None:
        """Take values of fields of the last message on a topic, by path."""
        if time - time == 0:
            known = self._world.topics.get(topic)
            self._checks.fields.add(topic, time, values, known.types if known is not None else ())

    def add_frame(self, frame: Frame) -> None:
        """Take everything that an observer reports at once."""
        observer_status = self.take_report(frame.sender, frame.vouched, of_graph=frame.graph is not None)
        self.add_tallies(frame.tallies, observer_status)
        for sample in frame.samples:
            self.add_sample(sample, observer_status)
        for event in frame.events:
            self.add_event(event)
        if frame.graph is not None:
            self.add_graph(frame.graph, frame.time)
        self.failures.extend(frame.failures)
        self.shed += max(frame.shed, 0)

    def begin(self, time: float) -> None:
        """Let the grace of entities that were not observed yet count from ``time``: they could not be before."""
        self._began = time
        self._checks.presences.look_again()
        for one in self._world.entities():
            if not one.seen:
                one.appeared = time
                self._evaluator.wait(one)

    def clock_stands(self, time: float) -> None:
        """Suspend what is judged of traffic until :meth:`clock_runs`, :meth:`clock_jumped` or the next message."""
        self._held = True
        self._suspend(time)

    def clock_runs(self, time: float) -> None:
        """Judge again from the next tick on, after grace."""
        self._held = False
        if self._evaluator.suspended:
            self._resume(time)

    def clock_jumped(self, time: float) -> None:
        """Forget the traffic before; everything is suspended in the next tick, and then has grace."""
        self._clock = ClockWatch(time)
        self._jump(time)
        self._settling = True

    def replace_reference(self, reference: Reference) -> None:
        """Judge by another reference; what did not change keeps windows and states.

        Raises:
            ValueError: a pattern of the reference is none; the old one is kept.
        """
        rules = Rulebook(reference, self._rules)
        now = self._clock.now
        self._rules = rules
        self.reacts = bool(reference.reactions)
        dropped = self._checks.replace(rules, now)
        self._existence.presences = self._checks.presences
        self._retire(dropped, now)
        for one in self._world.entities():
            one.planless = True
            self._evaluator.wait(one)
        self._evaluator.wait_all(self._existence.know(*required(self._world, rules, now)))
        self._explained.stale = True

    def tick(self, now: float) -> tuple[Verdict, ...]:
        """Judge what has news or is due; return what changed its state or cause, by entity and expectation."""
        self._follow_clock(now)
        now = self._clock.now
        moved, self._moved = self._moved, []
        if turned := self._observers.settle(now):
            moved += turned
            self._checks.look_again()
        moved += self._judge(now)
        changed = {one: None for one in moved if one.state.state is not one.reported}
        for one in changed:
            one.reported = one.state.state
            self._explained.note(one)
        changed.update(dict.fromkeys(self._explained.explain(now)))
        verdicts = {(one.entity, one.expectation): one for one in self._retired}
        self._retired = []
        verdicts.update((one.key, one.verdict()) for one in changed)
        return tuple(verdicts[key] for key in sorted(verdicts))

    def standing(self) -> tuple[Verdict, ...]:
        """Return every verdict as it stands, sorted by entity and expectation."""
        self._moved += self._evaluator.look_again(self._clock.now)
        return tuple(one.verdict() for one in sorted(self._standing(), key=lambda one: one.key))

    def tolerance(self, tally: Tally) -> float:
        """Return how wrong times of a tally may be so that constraints on them can be judged: half of what is fine."""
        return tolerance(self._world, tally)

    def next_due(self, now: float) -> float:
        """Return when a tick could change something if nothing comes; infinity where only news can."""
        if self._moved or self._retired:
            return now
        return max(min(self._evaluator.due, self._checks.due), now)

    def tree(self, now: float) -> SystemView:
        """Return the system by host, node, topic and connection, with worst states and latest values."""
        self._moved += self._evaluator.look_again(self._clock.now)
        return self._glances.tree.view(self._standing(), now)

    def glance(self, now: float, looked_at: Collection[str]) -> Glance:
        """Return tree and verdicts; values of topics that are not displayed may be some seconds old, states never."""
        turn = self._glances.turn(looked_at, now)
        self._moved += self._evaluator.look_again(self._clock.now, *turn)
        return self._glances.at(self._standing(), now, turn)

    def _standing(self) -> Iterator[Standing]:
        return chain(
            self._checks.standing,
            self._observers.standing(),
            self._explained.faults,
            chain.from_iterable(one.judged for one in self._world.entities()),
        )

    def _follow_clock(self, now: float) -> None:
        course = self._clock.tick(now)
        if course is Course.JUMPED:
            self._jump(now)
        elif course is Course.STANDS:
            self._suspend(now)
        elif self._settling:
            self._settling = False
        elif self._evaluator.suspended and not self._held:
            self._resume(now)

    def _traffic(self) -> Iterator[Standing]:
        return chain(
            self._checks.traffic,
            *(one.judged for one in self._world.entities() if not isinstance(one, Sampled)),
        )

    def _suspend(self, time: float) -> None:
        if self._evaluator.suspended:
            return
        self._evaluator.suspended = True
        for connection in self._world.connections.values():
            connection.wake()
        for one in self._traffic():
            one.forget(time, State.SUSPENDED)
            self._moved.append(one)

    def _resume(self, time: float) -> None:
        """Start again: data from before the break is no evidence about data after it."""
        self._evaluator.suspended = False
        self._began = time
        self._checks.fields.clear()
        for one in self._world.entities():
            one.resume(time)
            self._evaluator.wait(one)
        for standing in self._traffic():
            standing.forget(time, State.UNKNOWN)
            self._moved.append(standing)

    def _jump(self, time: float) -> None:
        self._held = False
        self._suspend(time)
        self._began = time
        self._observers.shift(time)
        self._checks.jump(time)
        self._evaluator.forget_due()
        self._sweep_due = time
        for one in self._world.entities():
            one.planned = one.due = float("inf")
            if isinstance(one, Sampled):
                one.clear(time)
                self._evaluator.wait(one)

    def _judge(self, now: float) -> list[Standing]:
        changed: list[Standing] = [*self._evaluator.judge(now)]
        if not self._evaluator.suspended:
            changed += self._checks.judge_traffic(now, self._began)
        changed += self._checks.judge_presence(now, self._began, self._existence.vanished, self._observers)
        if now >= self._sweep_due:
            self._sweep_due = now + _SWEEP_S
            self._sweep(now)
        return changed

    def _plan(self, entities: Iterable[Measured], now: float) -> None:
        for one in entities:
            if one.planless:
                self._retire(plan(one, self._world, self._rules, now), now)

    def _retire(self, dropped: Iterable[Standing], now: float) -> None:
        """Set verdicts that are no longer judged to unknown."""
        for one in dropped:
            self._explained.drop(one)
            if one.reported is not State.UNKNOWN:
                one.state.step(now, State.UNKNOWN, None)
                one.window, one.evidence = None, "judged no more"
                self._retired.append(one.verdict())

    def _sweep(self, now: float) -> None:
        """Let go of what is gone for long."""
        gone, topics = self._existence.let_go(now)
        if topics:
            self._known.clear()
            self._evaluator.wait_all(topics)
        for one in gone:
            self._retire(one.judged, now)
