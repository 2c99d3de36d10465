"""Which constraints an entity is judged by, and which windows they need: looked up once, until something changes."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.live.standing.measured import Judged, Measured
from roslens.live.standing.ready_constraint import ReadyConstraint, window_length
from roslens.live.standing.rulebook import Rulebook
from roslens.live.system.connection import Connection
from roslens.live.system.sampled import Sampled
from roslens.live.system.topic import Topic
from roslens.live.system.world import World
from roslens.live.window.host_clocks import USUAL_TOLERANCE_S
from roslens.live.window.window import MAX_BUCKETS, MAX_VALUES
from roslens.model.entity import EntityKind
from roslens.model.traffic.tally import Tally

_TIMES = frozenset({"latency", "latency_max", "age", "age_max"})
_SAMPLED = (EntityKind.HOST, EntityKind.NODE, EntityKind.PROCESS, EntityKind.SERVICE)


def required(world: World, rules: Rulebook, now: float) -> list[Measured]:
    """Return the entities that the rules name without wildcards, created if they were not observed yet."""
    found: list[Measured] = []
    for kind, name in rules.required:
        entity: Measured | None = None
        if kind in (EntityKind.TOPIC, EntityKind.CONNECTION):
            entity = world.topic(name, now)
        elif kind in _SAMPLED:
            entity = world.entity_named(kind, name, now)
        if entity is not None:
            found.append(entity)
    return found


def plan(entity: Measured, world: World, rules: Rulebook, now: float) -> list[Judged]:
    """Look up the constraints about an entity; return what is judged no more."""
    if isinstance(entity, Connection):
        return _plan_connection(entity, world, rules, now)
    if isinstance(entity, Topic):
        return _plan_topic(entity, world, rules, now)
    if isinstance(entity, Sampled):
        constraints = rules.about(entity.id.kind, entity.id.name, world.facts(entity))
        if not entity.seen:
            constraints = _with(constraints, rules.required.get((entity.id.kind, entity.id.name), ()))
        dropped = entity.adopt(constraints, now)
        entity.keep(max((one.timing.window for one in constraints), default=0.0))
        return dropped
    return []


def _plan_connection(connection: Connection, world: World, rules: Rulebook, now: float) -> list[Judged]:
    topic = world.topics[connection.topic]
    dropped = [] if not topic.planless else _plan_topic(topic, world, rules, now)
    if not connection.planless:
        return dropped
    dropped += connection.adopt(_about(connection, world, rules), now)
    asked = _lengths(judged.constraint for judged in connection.judged)
    percentile = any(judged.constraint.percentile for judged in connection.judged)
    if not asked <= set(topic.lengths) or (percentile and topic.most == MAX_BUCKETS):
        return dropped + _plan_topic(topic, world, rules, now)
    _place(connection, topic.lengths, topic.most)
    return dropped


def _plan_topic(topic: Topic, world: World, rules: Rulebook, now: float) -> list[Judged]:
    constraints = rules.about(EntityKind.TOPIC, topic.name, world.facts(topic))
    if not topic.seen:
        constraints = _with(constraints, rules.required.get((EntityKind.TOPIC, topic.name), ()))
    if not topic.connections:
        constraints = _with(constraints, rules.required.get((EntityKind.CONNECTION, topic.name), ()))
    dropped = topic.adopt(constraints, now)
    connections = [one for group in topic.connections.values() for one in group]
    for connection in connections:
        if connection.planless:
            dropped += connection.adopt(_about(connection, world, rules), now)
    every = [judged.constraint for one in (topic, *connections) for judged in one.judged]
    usual = window_length(max((one.period for one in every if not one.window), default=0.0))
    topic.most = MAX_VALUES if any(one.percentile for one in every) else MAX_BUCKETS
    topic.lengths = (usual, *sorted(_lengths(every) - {usual}))
    _place(topic, topic.lengths, topic.most)
    for connection in connections:
        _place(connection, topic.lengths, topic.most)
    return dropped


def _place(entity: Connection | Topic, lengths: tuple[float, ...], most: int) -> None:
    """Let each constraint of an entity take its window."""
    if isinstance(entity, Connection):
        entity.resize(lengths, most)
    for judged in entity.judged:
        window = judged.constraint.window
        judged.at = lengths.index(window) if window else 0
    entity.gather()


def _about(connection: Connection, world: World, rules: Rulebook) -> tuple[ReadyConstraint, ...]:
    """Return the constraints on a connection; what is seen at a publisher alone is none where its subscribers tell."""
    if not connection.subscriber:
        beside = world.topics[connection.topic].connections.get(connection.publisher, ())
        if any(one.subscriber and not one.gone for one in beside):
            return ()
    return rules.about(EntityKind.CONNECTION, connection.topic, world.facts(connection))


def _lengths(constraints: Iterable[ReadyConstraint]) -> set[float]:
    return {one.window for one in constraints if one.window}


def _with(constraints: tuple[ReadyConstraint, ...], more: Iterable[ReadyConstraint]) -> tuple[ReadyConstraint, ...]:
    return tuple(sorted({*constraints, *more}, key=lambda one: one.details.id))


def tolerance(world: World, tally: Tally) -> float:
    """Return how wrong times of a tally may be so that constraints on them can be judged: half of what is fine."""
    connection = world.connections.get((tally.topic, tally.publisher, tally.subscriber))
    entities = filter(None, (connection, world.topics.get(tally.topic)))
    highest = [
        one.constraint.bounds.high for entity in entities for one in entity.judged if one.constraint.key in _TIMES
    ]
    return min(highest) / 2 if highest else USUAL_TOLERANCE_S
