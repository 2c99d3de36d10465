"""The system as a tree: hosts, their nodes, the topics these publish and the connections of those, and services."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Protocol

import msgspec

from roslens.live.standing.standing import Standing
from roslens.live.system.command_name import command_name
from roslens.live.system.sampled import Sampled
from roslens.live.system.world import World
from roslens.live.window.signals import ENDS
from roslens.live.window.traffic import MEASURES
from roslens.live.window.window import Window
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph, Role
from roslens.model.verdict import State

_TOPIC_SIGNALS = (*MEASURES, *sorted(ENDS))
_WORSE = {state: place for place, state in enumerate(State)}
UNKNOWN_NAME = ""
"""Name of the host of nodes of which nobody knows where they are, and of the node of topics nobody publishes."""


class SystemView(msgspec.Struct, frozen=True, omit_defaults=True):
    """A part of the system, or all of it.

    Attributes:
        id: text form of the id of the entity; ``system`` of the whole.
        name: to show.
        kind: ``system``, ``host``, ``node``, ``process``, ``topic``, ``service`` or ``connection``.
        state: worst state of what is said of it alone; None where nothing judges it.
        counts: how many verdicts of it and everything below are in which state, by the state's name.
        values: latest values of its own, by key of the signal.
        observer: how these were observed; empty where there are none.
        children: the parts below, sorted by name.
        below: how many verdicts of what is below it are in which state, by the state's name.
        worst: worst state of it and everything below; None where nothing of that is judged.
    """

    id: str
    name: str
    kind: str
    state: State | None = None
    counts: dict[str, int] = {}
    values: dict[str, float] = {}
    observer: str = ""
    children: tuple[SystemView, ...] = ()
    below: dict[str, int] = {}
    worst: State | None = None


class Parts(Protocol):
    """What a tree is made of: a system that runs, or one that did."""

    @property
    def graph(self) -> Graph | None:
        """Who is there; None before anybody looked."""

    @property
    def sampled(self) -> Collection[EntityId]:
        """Hosts, nodes, processes and services of which values are known."""

    @property
    def topics(self) -> Iterable[str]:
        """Names of all topics."""

    def host_of(self, node: str) -> str:
        """Return the host of a node, empty where unknown."""

    def publishers_of(self, topic: str) -> Iterable[str]:
        """Return the nodes that publish a topic, or did last; the empty name for unknown ones with connections."""

    def connections_of(self, topic: str, node: str) -> Iterable[EntityId]:
        """Return the connections of a topic from one node."""

    def values_of(self, entity: EntityId) -> tuple[dict[str, float], str]:
        """Return the latest values of an entity, and how they were observed."""


def view_of(world: World, standing: Iterable[Standing], now: float) -> SystemView:
    """Return the tree at ``now``; an entity below several others counts once in what is above them all."""
    states: dict[EntityId, list[State]] = {}
    for one in standing:
        states.setdefault(one.entity, []).append(one.state.state)
    return tree_of(_Running(world, now), states)


def tree_of(parts: Parts, states: dict[EntityId, list[State]]) -> SystemView:
    """Return the tree of parts and of how each entity stands by every sentence about it."""
    return _Tree(parts, states).build()


class _Running:
    """The parts of a system that runs."""

    def __init__(self, world: World, now: float) -> None:
        self._world = world
        self._now = now
        self._topics: dict[str, tuple[dict[str, float], str]] = {}
        self.host_of = world.host_of

    @property
    def graph(self) -> Graph | None:
        return self._world.graph

    @property
    def sampled(self) -> Collection[EntityId]:
        return self._world.sampled

    @property
    def topics(self) -> Iterable[str]:
        return self._world.topics

    def publishers_of(self, topic: str) -> Iterable[str]:
        known = self._world.topics[topic]
        return {*(known.publishers or known.former), *filter(None, known.connections)}

    def connections_of(self, topic: str, node: str) -> Iterable[EntityId]:
        return [one.id for one in self._world.topics[topic].connections.get(node, ())]

    def values_of(self, entity: EntityId) -> tuple[dict[str, float], str]:
        sampled = self._world.sampled.get(entity)
        if sampled is not None:
            return _of_sampled(sampled, self._now)
        if entity.kind is EntityKind.TOPIC:
            return self._of_topic(entity.name)
        if entity.kind is EntityKind.CONNECTION:
            connection = self._world.connection_of(entity)
            if connection is not None:
                connection.settle(self._now)
                return _told((key, connection.value(key, 0)) for key in MEASURES)
        return {}, ""

    def _of_topic(self, name: str) -> tuple[dict[str, float], str]:
        """Return the values of a topic, which stands below each of its publishers."""
        if name not in self._topics:
            topic = self._world.topics[name]
            for one in topic.all_connections():
                one.settle(self._now)
            self._topics[name] = _told(topic.values(_TOPIC_SIGNALS, 0))
        return self._topics[name]


_NOTHING: tuple[None, dict[str, int]] = (None, {})
"""What nothing judges; one for all, and nobody writes into it."""


class _Tree:
    def __init__(self, parts: Parts, states: dict[EntityId, list[State]]) -> None:
        self._parts = parts
        self._graph = parts.graph
        self._states = states
        self._services: dict[str, set[EntityId]] = {}

    def build(self) -> SystemView:
        placed = self._placed()
        self._place_services()
        for node in self._services:
            placed.setdefault(node, set())
        commands = {}
        for process in self._graph.processes if self._graph else ():
            commands[f"{process.host}/{process.pid}"] = command_name(process.command)
        hosts: dict[str, list[SystemView]] = {}
        below: dict[str, set[EntityId]] = {}
        for node in sorted(placed):
            view, entities = self._node(node, placed[node])
            host = self._parts.host_of(node) if node else UNKNOWN_NAME
            hosts.setdefault(host, []).append(view)
            below.setdefault(host, set()).update(entities)
        others = [one for one in self._states if one.kind not in (EntityKind.NODE, EntityKind.TOPIC)]
        for entity in dict.fromkeys((*self._parts.sampled, *others)):
            if entity.kind is EntityKind.HOST:
                hosts.setdefault(entity.name, [])
            elif entity.kind is EntityKind.PROCESS:
                host = entity.name.rpartition("/")[0]
                shown = " ".join(filter(None, (entity.name, commands.get(entity.name, ""))))
                hosts.setdefault(host, []).append(self._view(entity, {entity}, (), shown))
                below.setdefault(host, set()).add(entity)
        views = []
        everything: set[EntityId] = set(self._states)
        for name in sorted(hosts):
            entity = EntityId(EntityKind.HOST, name)
            views.append(self._view(entity, {entity} | below.get(name, set()), tuple(hosts[name])))
        worst, counts = self._sum(everything)
        return SystemView("system", "system", "system", None, counts, {}, "", tuple(views), counts, worst)

    def _placed(self) -> dict[str, set[str]]:
        """Return the topics of each node; those without a publisher under no name."""
        placed: dict[str, set[str]] = {}
        for node in self._graph.nodes if self._graph else ():
            placed.setdefault(node.name, set())
        for entity in (*self._parts.sampled, *self._states):
            if entity.kind is EntityKind.NODE:
                placed.setdefault(entity.name, set())
        for topic in self._parts.topics:
            for name in set(self._parts.publishers_of(topic)) or (UNKNOWN_NAME,):
                placed.setdefault(name, set()).add(topic)
        return placed

    def _node(self, node: str, topics: set[str]) -> tuple[SystemView, set[EntityId]]:
        entity = EntityId(EntityKind.NODE, node)
        below = {entity}
        views = []
        for name in sorted(topics):
            view, entities = self._topic(name, node)
            views.append(view)
            below |= entities
        for service in sorted(self._services.get(node, ())):
            views.append(self._view(service, {service}, ()))
            below.add(service)
        return self._view(entity, below, tuple(views)), below

    def _place_services(self) -> None:
        """Note the servers of each service of which something is known; those without one under no name."""
        servers: dict[str, set[str]] = {}
        for end in self._graph.endpoints if self._graph else ():
            if end.role is Role.SERVICE_SERVER:
                servers.setdefault(end.name, set()).add(end.node)
        for entity in (*self._parts.sampled, *self._states):
            if entity.kind is EntityKind.SERVICE:
                for node in servers.get(entity.name) or (UNKNOWN_NAME,):
                    self._services.setdefault(node, set()).add(entity)

    def _topic(self, topic: str, node: str) -> tuple[SystemView, set[EntityId]]:
        mine = sorted(self._parts.connections_of(topic, node))
        entity = EntityId(EntityKind.TOPIC, topic)
        below = {entity, *mine}
        return self._view(entity, below, tuple(self._view(one, {one}, ()) for one in mine)), below

    def _view(
        self, entity: EntityId, below: set[EntityId], children: tuple[SystemView, ...], name: str = ""
    ) -> SystemView:
        state, own = self._sum({entity}) if entity in self._states else _NOTHING
        worst, counts, others = state, own, _NOTHING[1]
        if len(below) > 1 or entity not in below:
            worst, counts = self._sum(below | {entity})
            others = self._sum(below - {entity})[1]
        values, observer = self._parts.values_of(entity)
        shown = name or entity.name
        kind = entity.kind.value
        return SystemView(str(entity), shown, kind, state, counts, values, observer, children, others, worst)

    def _sum(self, entities: set[EntityId]) -> tuple[State | None, dict[str, int]]:
        states = [state for entity in entities if entity in self._states for state in self._states[entity]]
        if not states:
            return _NOTHING
        counts = {state.value: states.count(state) for state in State if state in states}
        return max(states, key=_WORSE.__getitem__, default=None), counts


def _of_sampled(sampled: Sampled, now: float) -> tuple[dict[str, float], str]:
    values = sampled.latest(now)
    return values, sampled.observer.value if sampled.observer and values else ""


def _told(signals: Iterable[tuple[str, tuple[float | None, Window | None]]]) -> tuple[dict[str, float], str]:
    values: dict[str, float] = {}
    observer = ""
    for key, (value, window) in signals:
        if value is not None:
            values[key] = value
            observer = observer or (window.observer.value if window else "")
    return values, observer
