"""The system as a tree: hosts, their nodes, the topics these publish and the connections of those, and services."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import NamedTuple, Protocol, TypeAlias

import msgspec

from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph, Role
from roslens.model.verdict import State
from roslens.model.words.command_name import command_name

_WORSE = {state: place for place, state in enumerate(State)}
UNKNOWN_NAME = ""
"""Name of the host of nodes on unknown hosts, and of the node of topics without a publisher."""


States: TypeAlias = "Mapping[EntityId, Sequence[State]]"
"""How entities stand by every constraint about them."""
Reported: TypeAlias = "tuple[dict[str, float], str]"
"""Values by key of the signal, and how they were observed."""


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
        """The graph; None before the first observation."""

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

    def values_of(self, entity: EntityId) -> Reported:
        """Return the latest values of an entity, and how they were observed."""


def tree_of(parts: Parts, states: States) -> SystemView:
    """Return the tree of parts and of how each entity stands by every constraint about it.

    An entity below several others counts once in what is above them all.
    """
    plan = Plan(parts, states)
    whole = plan.view(parts.values_of, states)
    plan.dissolve()
    return whole


class _Sums(NamedTuple):
    """How a part stands itself, with all below it, and what alone is below it."""

    state: State | None
    worst: State | None
    counts: dict[str, int]
    below: dict[str, int]


class _Part:
    """A part of a plan, and its view as long as nothing of it changes.

    Attributes:
        entity: that it shows; a topic of several publishers has a part below each.
        name: to show.
        children: the parts below, in order.
        below: everything in it, itself included.
        view: made last; None where it has to be made.
        sums: worst state and counts of ``view``; None where a state changed since.
        above: the part that it is a child of; None of hosts.
    """

    __slots__ = ("above", "below", "children", "entity", "name", "sums", "view")

    def __init__(self, entity: EntityId, children: Sequence[_Part] = (), name: str = "") -> None:
        self.entity = entity
        self.name = name or entity.name
        self.children = tuple(children)
        self.below: set[EntityId] = {entity}.union(*(one.below for one in self.children))
        self.view: SystemView | None = None
        self.sums: _Sums | None = None
        self.above: _Part | None = None
        for one in self.children:
            one.above = self

    def made(self, values_of: Callable[[EntityId], Reported], states: States) -> SystemView:
        """Return its view, the same as before where nothing changed."""
        before = self.view
        if before is not None:
            return before
        children = tuple([one.view or one.made(values_of, states) for one in self.children])
        entity = self.entity
        sums = self.sums or self._sums(states)
        self.sums = sums
        values, observer = values_of(entity)
        self.view = SystemView(
            str(entity), self.name, entity.kind.value, sums.state, sums.counts, values, observer, children, sums.below,
            sums.worst,
        )  # fmt: skip
        return self.view

    def _sums(self, states: States) -> _Sums:
        entity = self.entity
        state, own = _sum((entity,), states) if entity in states else _NOTHING
        if len(self.below) == 1:
            return _Sums(state, state, own, _NOTHING[1])
        worst, counts = _sum(self.below, states)
        return _Sums(state, worst, counts, _sum(self.below - {entity}, states)[1])


class Plan:
    """Where each entity of a system stands in its tree; views of what did not change are the same objects again."""

    def __init__(self, parts: Parts, states: Collection[EntityId]) -> None:
        """Place what is there, and what ``states`` are about."""
        self._hosts = _Placing(parts, states).hosts()
        self._whole: tuple[States, _Sums] | None = None
        self._places: dict[EntityId, list[_Part]] = {}
        waiting = [*self._hosts]
        while waiting:
            part = waiting.pop()
            self._places.setdefault(part.entity, []).append(part)
            waiting += part.children

    def change(self, values: Iterable[EntityId], states: Iterable[EntityId]) -> None:
        """Let what shows these ``values`` be made anew, and what counts these ``states`` be counted anew."""
        for entity in states:
            for place in self._places.get(entity, ()):
                part: _Part | None = place
                while part is not None and part.sums is not None:
                    part.view = part.sums = None
                    part = part.above
        for entity in values:
            for place in self._places.get(entity, ()):
                part = place
                while part is not None and part.view is not None:
                    part.view = None
                    part = part.above

    def dissolve(self) -> None:
        """Let go of what is above each part: nothing but the collector of cycles would free them otherwise."""
        for places in self._places.values():
            for part in places:
                part.above = None

    def view(self, values_of: Callable[[EntityId], Reported], states: States) -> SystemView:
        """Return the whole tree."""
        hosts = tuple([one.made(values_of, states) for one in self._hosts])
        if self._whole is None or self._whole[0] is not states:
            worst, counts = _sum(states, states)
            self._whole = states, _Sums(None, worst, counts, counts)
        sums = self._whole[1]
        return SystemView("system", "system", "system", None, sums.counts, {}, "", hosts, sums.below, sums.worst)


_NOTHING: tuple[None, dict[str, int]] = (None, {})
"""The state of an entity that nothing judges; shared and never modified."""


class _Placing:
    """Finds what stands below what."""

    def __init__(self, parts: Parts, states: Collection[EntityId]) -> None:
        self._parts = parts
        self._graph = parts.graph
        self._states = states
        self._services: dict[str, set[EntityId]] = {}

    def hosts(self) -> list[_Part]:
        placed = self._placed()
        self._place_services()
        for node in self._services:
            placed.setdefault(node, set())
        commands = {}
        for process in self._graph.processes if self._graph else ():
            commands[f"{process.host}/{process.pid}"] = command_name(process.command)
        hosts: dict[str, list[_Part]] = {}
        for node in sorted(placed):
            host = self._parts.host_of(node) if node else UNKNOWN_NAME
            hosts.setdefault(host, []).append(self._node(node, placed[node]))
        others = [one for one in self._states if one.kind not in (EntityKind.NODE, EntityKind.TOPIC)]
        for entity in dict.fromkeys((*self._parts.sampled, *others)):
            if entity.kind is EntityKind.HOST:
                hosts.setdefault(entity.name, [])
            elif entity.kind is EntityKind.PROCESS:
                host = entity.name.rpartition("/")[0]
                shown = " ".join(filter(None, (entity.name, commands.get(entity.name, ""))))
                hosts.setdefault(host, []).append(_Part(entity, (), shown))
        return [_Part(EntityId(EntityKind.HOST, name), hosts[name]) for name in sorted(hosts)]

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

    def _node(self, node: str, topics: set[str]) -> _Part:
        below = [self._topic(name, node) for name in sorted(topics)]
        below += [_Part(service) for service in sorted(self._services.get(node, ()))]
        return _Part(EntityId(EntityKind.NODE, node), below)

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

    def _topic(self, topic: str, node: str) -> _Part:
        mine = sorted(self._parts.connections_of(topic, node))
        return _Part(EntityId(EntityKind.TOPIC, topic), [_Part(one) for one in mine])


def _sum(entities: Iterable[EntityId], states: States) -> tuple[State | None, dict[str, int]]:
    found = [state for entity in entities if entity in states for state in states[entity]]
    if not found:
        return _NOTHING
    counts = {state.value: count for state in State if (count := found.count(state))}
    return max(set(found), key=_WORSE.__getitem__), counts
