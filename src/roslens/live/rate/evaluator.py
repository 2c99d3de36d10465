"""Which entities are looked at in a tick: those with news or due, but not what cannot have changed a verdict."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import chain

from roslens.live.rate.due_queue import DueQueue
from roslens.live.rate.envelope_of import envelope_of
from roslens.live.rate.existence import Existence
from roslens.live.rate.judging import judge_connection, judge_sampled, judge_topic
from roslens.live.standing.measured import Judged, Measured
from roslens.live.standing.verdict_state import NEVER
from roslens.live.system.connection import Connection
from roslens.live.system.sampled import Sampled
from roslens.live.system.topic import Topic
from roslens.live.system.world import World
from roslens.live.window.observer_status import ObserverStatus
from roslens.live.window.round import Round

RETRY_S = 1.0
"""Seconds after which it is found out again whether a connection need not be looked at."""


class Evaluator:
    """Judges what has to be judged.

    Attributes:
        round: the time since the last tick.
        waiting: entities with news that has to be looked at.
        received: whether tallies came in the round that cannot have changed a verdict.
        suspended: whether nothing is judged of traffic.
        silent: observers that do not report.
    """

    def __init__(self, world: World, existence: Existence, plan: Callable[[Iterable[Measured], float], None]) -> None:
        """Begin without any; ``plan`` looks up the constraints of those for which that has to be done again."""
        self.round = Round()
        self.waiting: list[Measured] = []
        self.suspended = False
        self._world = world
        self._existence = existence
        self._plan = plan
        self._queue = DueQueue()
        self.received = False
        self.silent: list[ObserverStatus] = []

    @property
    def due(self) -> float:
        """When something has to be looked at; minus infinity where news waits for it."""
        return -NEVER if self.waiting or self.received else self._queue.first

    def wait(self, one: Measured) -> None:
        """Look at an entity in the next tick."""
        if not one.waiting:
            one.waiting = True
            self.waiting.append(one)

    def wait_all(self, entities: Iterable[Measured]) -> None:
        """Look at entities in the next tick, and look up their constraints again."""
        for one in entities:
            one.planless = True
            self.wait(one)

    def forget_due(self) -> None:
        """Forget when something is due: time itself broke."""
        self._queue = DueQueue()

    def judge(self, now: float) -> list[Judged]:
        """Judge what has news or is due; return what changed."""
        if not self.suspended:
            self.round.time = now
            self.round = Round()
            self.received = False
        topics, others = self._awake(now)
        self._plan((*topics, *others), now)
        changed: list[Judged] = []
        for one in (*others, *topics):
            changed += self._judge_one(one, now)
        for topic in topics:
            _rest(topic, now)
        for one in (*others, *topics):
            if one.due < one.planned:
                self._queue.put(one)
        return changed

    def _awake(self, now: float) -> tuple[dict[Topic, None], dict[Measured, None]]:
        """Return what has to be judged, topics apart; a connection that stays inside its envelope rests on."""
        waiting, self.waiting = self.waiting, []
        topics: dict[Topic, None] = {}
        others: dict[Measured, None] = {}
        for one in (*waiting, *self._queue.take(now)):
            one.waiting = False
            if type(one) is Connection:
                envelope = one.envelope
                if envelope is not None and not self.suspended:
                    if one.notice(envelope, now):
                        self._queue.put(one)
                        continue
                    one.wake()
                topics[self._world.topics[one.topic]] = None
                others[one] = None
            elif isinstance(one, Topic):
                topics[one] = None
            else:
                others[one] = None
        return topics, others

    def look_again(
        self, now: float, topics: Iterable[Topic] | None = None, still: Iterable[Topic] = ()
    ) -> list[Judged]:
        """Bring values of ``topics``, or of all, to the present that nobody had to look at; return what changed.

        All is fine of ``still`` ones, and of them and of their connections nothing new was reported.
        """
        self._plan(self.waiting, now)
        changed: list[Judged] = []
        if self.suspended:
            return changed
        for topic in self._world.topics.values() if topics is None else topics:
            for one in chain.from_iterable(topic.connections.values()):
                if one.looked < now and one.judged and not one.planless:
                    changed += judge_connection(one, now)
                    self._queue.put(one)
            if topic.looked < now and topic.judged and not topic.planless:
                changed += judge_topic(topic, now, graph_known=self._world.graph is not None, silent=self.silent)
                self._queue.put(topic)
        for topic in still:
            for measured in (*chain.from_iterable(topic.connections.values()), topic):
                measured.looked = max(measured.looked, now)
        return changed

    def _judge_one(self, one: Measured, now: float) -> Iterable[Judged]:
        if isinstance(one, Sampled):
            judged = judge_sampled(one, now)
            if one.seen and one.missed(now):
                self._existence.take_silence(one, now)
            return judged
        if self.suspended:
            return ()
        if isinstance(one, Connection):
            return judge_connection(one, now)
        if isinstance(one, Topic) and one.judged:
            return judge_topic(one, now, graph_known=self._world.graph is not None, silent=self.silent)
        return ()


def _rest(topic: Topic, now: float) -> None:
    """Find out which connections need not be judged as long as their tallies are as they are.

    Those of a topic that is judged rest together, for what is fine of one depends on the others.
    """
    every = [one for one in chain.from_iterable(topic.connections.values()) if not topic.tells_nothing(one)]
    if topic.judged and not topic.calm:
        _wake(every)
        return
    for group in [every] if topic.judged else [[one] for one in every]:
        if any(one.envelope is None for one in group):
            _wake(group)
            if all(one.calm and now >= one.patience for one in group):
                _try_to_rest(group, topic, now)
    if every and all(one.envelope is not None for one in every):
        # Its connections wait for it.
        topic.due = NEVER


def _try_to_rest(group: list[Connection], topic: Topic, now: float) -> None:
    envelopes = [envelope_of(one, topic) for one in group]
    for one, envelope in zip(group, envelopes, strict=True):
        if envelope is None:
            one.patience = now + RETRY_S
        elif None not in envelopes:
            one.envelope = envelope


def _wake(connections: Iterable[Connection]) -> None:
    for one in connections:
        one.wake()
