"""What exists: by the graph, by events, and by what is sampled or reported of it."""

from __future__ import annotations

from roslens.live.standing.measured import Measured
from roslens.live.standing.presence import Key, Presences
from roslens.live.standing.rulebook import NOTHING_KNOWN, Facts
from roslens.live.system.connection import Connection
from roslens.live.system.sampled import Sampled
from roslens.live.system.topic import Topic
from roslens.live.system.world import World
from roslens.live.window.newest import keep_newest
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Event, Graph
from roslens.model.traffic.tally import Tally


class Existence:
    """Informs presences of what appears and vanishes.

    A host of which there are samples lives as long as they come, whatever the graph remembers of it. What an event
    said to have vanished stays so until a later graph, sample or event has it.

    Attributes:
        presences: that were declared; replaced with the reference.
        vanished: when what is gone went, of what went last.
    """

    def __init__(self, world: World, presences: Presences) -> None:
        self.presences = presences
        self.vanished: dict[Key, float] = {}
        self._world = world
        self._by_graph: set[Key] = set()

    def take_graph(self, graph: Graph, time: float, now: float) -> None:
        """Take what a graph has, and note what it has no more."""
        self.presences.fates.take_graph(graph)
        existing = self._world.existing(graph)
        for key, facts in existing.items():
            if self.vanished.get(key, time) <= time and not self._stale_host(key, now):
                self.appear(key, facts)
        for key in self._by_graph - existing.keys():
            if not self._sampled(key, now):
                self.vanish(key, time)
        self._by_graph = set(existing)
        for sampled in self._world.sampled.values():
            sampled.known = (sampled.id.kind, sampled.id.name) in existing

    def take_sample(self, sampled: Sampled, time: float) -> None:
        """Note that something was sampled."""
        key = (sampled.id.kind, sampled.id.name)
        if sampled.id.kind is EntityKind.SERVICE and self._world.graph is not None:
            # Its clients count calls too; who serves it is in the graph.
            return
        if key not in self.presences.existing and time > self.vanished.get(key, time - 1):
            self.appear(key, self._world.facts(sampled))

    def take_silence(self, sampled: Sampled, now: float) -> None:
        """Note that nothing is sampled of an entity any more."""
        key = (sampled.id.kind, sampled.id.name)
        if key in self.presences.existing and (not sampled.known or sampled.id.kind is EntityKind.HOST):
            self.vanish(key, sampled.noticed if sampled.seen else now)

    def know(self, *entities: Measured) -> tuple[Measured, ...]:
        """Note of entities that may be newer than the graph whether it has them; return them."""
        for one in entities:
            if isinstance(one, Sampled):
                one.known = (one.id.kind, one.id.name) in self._by_graph
        return entities

    def appear(self, key: Key, facts: Facts) -> None:
        """Note that something is there."""
        self.vanished.pop(key, None)
        self.presences.appear(key, facts)

    def vanished_by(self, event: Event, entity: EntityId) -> None:
        """Note that an event says that something is gone, and how it ended."""
        self.presences.happened(event, entity)
        self.vanish((entity.kind, entity.name), event.time)

    def vanish(self, key: Key, time: float) -> None:
        """Note that something is gone since ``time``."""
        if key in self.presences.existing:
            self.vanished.pop(key, None)
            self.vanished[key] = time
            keep_newest(self.vanished)
            self.presences.vanish(key)

    def meet(self, tally: Tally, now: float) -> Connection | None:
        """Make room for a connection that is new, and for what is known by it alone; None where there is none."""
        connection = self._world.connection(tally, now)
        if connection is None:
            return None
        topic = self._world.topics[tally.topic]
        if not topic.seen:
            # Grace counts from when a topic is there, not from when a subscriber began to wait for it.
            topic.appeared = now
        topic.add(connection)
        self._part(connection, topic)
        topic.planless = topic.planless or len(topic.connections) == 1
        self.presences.appear((connection.id.kind, connection.id.name), self._world.facts(connection))
        graph = self._world.graph
        if graph is None or not topic.known:
            self.presences.appear((EntityKind.TOPIC, topic.name), self._world.facts(topic))
        if graph is None:
            for node in filter(None, (tally.publisher, tally.subscriber)):
                self.presences.appear((EntityKind.NODE, node), NOTHING_KNOWN)
        return connection

    def _part(self, connection: Connection, topic: Topic) -> None:
        """Have what is seen at the publisher alone planned again: a subscriber of it reports now."""
        for one in topic.connections[connection.publisher]:
            if connection.subscriber and not one.subscriber:
                one.planless = topic.planless = True

    def let_go(self, now: float) -> tuple[list[Measured], list[Topic]]:
        """Forget what is gone for long, so that memory stays bounded.

        Returns:
            What is forgotten, and the topics that lost connections.
        """
        world, outdated = self._world, self._world.outdated(now)
        topics: list[Topic] = []
        for connection in outdated:
            world.forget(connection)
            self.vanish((connection.id.kind, connection.id.name), now)
            topic = world.topics[connection.topic]
            if not (topic.known or topic.connections):
                self.vanish((EntityKind.TOPIC, topic.name), now)
            topics.append(topic)
        if world.graph is None:
            ends = {node for one in world.connections.values() for node in (one.publisher, one.subscriber)}
            for node in {node for one in outdated for node in (one.publisher, one.subscriber)} - ends:
                self.vanish((EntityKind.NODE, node), now)
        samples, silent = [*world.outdated_samples(now)], [*world.outdated_topics()]
        for sampled in samples:
            del world.sampled[sampled.id]
        for topic in silent:
            del world.topics[topic.name]
        return [*outdated, *samples, *silent], topics

    def gone_nodes(self) -> dict[EntityId, float]:
        """Return the nodes that are gone, and since when."""
        gone = self.vanished.items()
        return {EntityId(kind, name): time for (kind, name), time in gone if kind is EntityKind.NODE}

    def _sampled(self, key: Key, now: float) -> bool:
        sampled = self._world.sampled_by(key)
        return sampled is not None and sampled.seen and sampled.fresh(now) and key[0] is EntityKind.HOST

    def _stale_host(self, key: Key, now: float) -> bool:
        sampled = self._world.sampled_by(key) if key[0] is EntityKind.HOST else None
        return sampled is not None and sampled.seen and not sampled.fresh(now)


def named_by(event: Event) -> EntityId | None:
    """Return what an event is about; None where it cannot be true."""
    try:
        return EntityId.parse(event.entity) if event.time - event.time == 0 else None
    except ValueError:
        return None
