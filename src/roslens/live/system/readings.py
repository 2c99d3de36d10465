"""The latest values of everything that a monitor knows, read again only where something may have changed them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain

from roslens.live.system.connection import Connection
from roslens.live.system.sampled import Sampled
from roslens.live.system.topic import Topic
from roslens.live.system.tree import Reported
from roslens.live.system.world import World
from roslens.live.window.signals import ENDS, RECEIVED
from roslens.live.window.traffic import MEASURES
from roslens.live.window.window import Window
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph
from roslens.model.traffic.tally import Observer

_TOPIC_SIGNALS = (*MEASURES, RECEIVED, *sorted(ENDS))
_WORDS = {one: one.value for one in Observer}
_NOTHING: Reported = ({}, "")
_OUTDATED = -1
"""In place of how many connections a topic had when it was read."""


class Readings:
    """Values by entity, each the same object until it changes.

    What a connection tells changes with its tallies, and by itself once it is silent for longer than is usual; what a
    topic tells with its connections and the graph; what is sampled with a sample, and when that is too old.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self._reported: dict[EntityId, Reported] = {}
        self._connections: dict[Connection, _Mark] = {}
        self._topics: dict[str, int] = {}
        self._samples: dict[EntityId, tuple[Sampled, float, bool]] = {}
        self._graph: Graph | None = None

    def of(self, entity: EntityId) -> Reported:
        """Return the latest values of an entity, and how they were observed."""
        return self._reported.get(entity, _NOTHING)

    def holds(self, topic: Topic, now: float) -> bool:
        """Return whether a topic and its connections still report at ``now`` what they reported when last read."""
        if self._graph is not self._world.graph:
            return False
        ends = 0
        marks = self._connections
        for connections in topic.connections.values():
            for one in connections:
                mark = marks.get(one)
                if mark is None or not mark.holds(one, now):
                    return False
                ends += 1
        return self._topics.get(topic.name) == ends

    def refresh(self, now: float, topics: Sequence[Topic] | None = None) -> list[EntityId]:
        """Bring everything to ``now`` on the monitor's clock; return of what the values are others than before.

        Of traffic only that of ``topics`` is read, where these are given.
        """
        changed: list[EntityId] = []
        self._forget()
        if topics is None:
            every: Iterable[Topic] = self._world.topics.values()
            connections: Iterable[Connection] = self._world.connections.values()
        else:
            every = topics
            connections = chain.from_iterable(chain.from_iterable(one.connections.values()) for one in topics)
        touched = self._read_connections(connections, now, changed)
        self._read_topics(every, touched, now, changed)
        self._read_samples(now, changed)
        return changed

    def _forget(self) -> None:
        """Let go of what the world has no more."""
        world = self._world
        if len(self._connections) > len(world.connections):
            there = set(world.connections.values())
            for gone in [one for one in self._connections if one not in there]:
                del self._connections[gone]
                self._reported.pop(gone.id, None)
        for name in self._topics.keys() - world.topics.keys():
            del self._topics[name]
            self._reported.pop(_topic_id(name), None)
        for entity in self._samples.keys() - world.sampled.keys():
            del self._samples[entity]
            self._reported.pop(entity, None)

    def _read_connections(self, connections: Iterable[Connection], now: float, changed: list[EntityId]) -> set[str]:
        """Read the connections whose values may have changed; return their topics."""
        touched = set()
        marks = self._connections
        for one in connections:
            mark = marks.get(one)
            if mark is not None and mark.holds(one, now):
                continue
            one.settle(now)
            touched.add(one.topic)
            self._take(one.id, _of_connection(one), changed)
            marks[one] = _Mark(one)
        return touched

    def _read_topics(self, topics: Iterable[Topic], touched: set[str], now: float, changed: list[EntityId]) -> None:
        if self._graph is not self._world.graph:
            # Each is read again when it is looked at next.
            self._graph, self._topics = self._world.graph, dict.fromkeys(self._topics, _OUTDATED)
        known = self._topics
        for topic in topics:
            name, ends = topic.name, sum(map(len, topic.connections.values()))
            if name in touched or known.get(name) != ends:
                known[name] = ends
                self._take(topic.id, _of_topic(topic, now), changed)

    def _read_samples(self, now: float, changed: list[EntityId]) -> None:
        for entity, sampled in self._world.sampled.items():
            mark = (sampled, sampled.stamp, sampled.fresh(now))
            if self._samples.get(entity) != mark:
                self._samples[entity] = mark
                values = sampled.latest(now)
                observer = sampled.observer.value if sampled.observer and values else ""
                self._take(entity, (values, observer), changed)

    def _take(self, entity: EntityId, reported: Reported, changed: list[EntityId]) -> None:
        if self._reported.get(entity) != reported:
            self._reported[entity] = reported
            changed.append(entity)


class _Mark:
    """By what a connection that was just brought to an instant is known to tell the same later."""

    __slots__ = ("_until", "_windows")

    def __init__(self, connection: Connection) -> None:
        self._windows = tuple((one, one.until, one.additions, one.observer_silent) for one in connection.newest)
        self._until = min((one.noticed + one.patience - max(one.lag, 0.0) for one in connection.newest), default=0.0)

    def holds(self, connection: Connection, now: float) -> bool:
        if now > self._until:
            return False
        windows = connection.newest
        if len(windows) != len(self._windows):
            return False
        for known, window in zip(self._windows, windows, strict=True):
            if (
                known[0] is not window
                or known[1] != window.until
                or known[2] != window.additions
                or known[3] is not window.observer_silent
            ):
                return False
        return True


def _of_connection(connection: Connection) -> Reported:
    windows = connection.newest
    if len(windows) != 1:
        return _reported((key, connection.value(key, 0)) for key in MEASURES)
    (window,) = windows
    if not window.spacing or window.observer_silent:
        return _NOTHING
    # The same as asking the connection for one signal after the other, which takes twice as long.
    cache = window.cache
    values = {}
    for key, measure in MEASURES.items():
        if key not in cache:
            cache[key] = measure(window)
        value = cache[key]
        if value is not None:
            values[key] = value
    return values, _WORDS[window.observer] if values else ""


def _of_topic(topic: Topic, now: float) -> Reported:
    for one in topic.all_connections():
        one.settle(now)
    return _reported(topic.values(_TOPIC_SIGNALS, 0))


def _topic_id(name: str) -> EntityId:
    return EntityId(EntityKind.TOPIC, name)


def _reported(signals: Iterable[tuple[str, tuple[float | None, Window | None]]]) -> Reported:
    values: dict[str, float] = {}
    observer = ""
    for key, (value, window) in signals:
        if value is not None:
            values[key] = value
            if not observer and window:
                observer = _WORDS[window.observer]
    return values, observer
