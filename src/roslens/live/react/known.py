"""What is known of a system at an instant, as conditions ask for it; fed with the steps of a session."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec

from roslens.live.join.session import Step
from roslens.live.react.presences import Presences
from roslens.live.system.connection_name import connection_ends
from roslens.live.system.misfit import misfits_by_topic
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph, Role
from roslens.model.verdict import State, Verdict

RETURNED_S = 3.0
"""So long after an observer is heard of again what it watches counts as unknown: it tells what it missed first."""
_OF_GRAPH = ("ros1", "ros2")
_FLEETING = (EntityKind.PROCESS, EntityKind.CONNECTION)
_SAMPLERS = ("agent", "monitor")


class Held(msgspec.Struct, frozen=True):
    """A verdict, and since when it has been bad or not, with that cause, as far as it was reported."""

    verdict: Verdict
    settled_at: float


class Traits(msgspec.Struct, frozen=True):
    """What selectors ask of an entity besides its name; several hosts, types or publishers are each enough."""

    hosts: tuple[str, ...] = ()
    types: tuple[str, ...] = ()
    publishers: tuple[str, ...] = ()
    subscriber: str = ""
    name: str = ""


class Known:
    """Verdicts, who is there, states and parameters, each as it was reported last.

    Attributes:
        now: of the latest step, in seconds on the monitor's clock.
        presences: who is there, gone, restarted…
        generation: grows whenever an entity is new.
    """

    def __init__(self, start: float) -> None:
        """Know nothing at ``start``."""
        self.now = start
        self.presences = Presences()
        self.generation = 0
        self._verdicts: dict[EntityId, dict[str, Held]] = {}
        self._graph: Graph | None = None
        self._misfits: dict[str, int] = {}
        self._silent: dict[str, float] = {}
        self._returned: dict[str, float] = {}
        self._ends: dict[str, tuple[set[str], set[str]]] = {}
        self._halted: dict[tuple[EntityId, bool], float] = {}
        self._bad: set[EntityId] = set()

    def take(self, step: Step, now: float) -> None:
        """Take the content of a step."""
        self.now = now
        for verdict in (*step.changes, *step.causes):
            self._judged(verdict)
        for event in step.events:
            self.generation += self.presences.happened(event)
        if step.graph is not None:
            self.generation += 1
            self._take_graph(step.graph, now)
        if step.halted is not None:
            self._halted = {(one.entity, one.hung): one.since for one in step.halted}

    def suspect(self, entity: EntityId) -> bool:
        """Whether anything may be wrong with an entity: of all others no fault is held."""
        return (
            entity in self._bad
            or self.presences.troubled(entity)
            or (entity, True) in self._halted
            or (entity, False) in self._halted
            or (entity.kind is EntityKind.TOPIC and self._misfits.get(entity.name, 0) > 0)
        )

    def verdicts(self, entity: EntityId) -> Iterable[Held]:
        """Return what is held of an entity."""
        return self._verdicts.get(entity, {}).values()

    def entities(self, kind: EntityKind) -> Iterator[EntityId]:
        """Yield the entities of a kind that were judged, or in the graph."""
        yield from (one for one in self._verdicts if one.kind is kind)
        if kind is EntityKind.PARAMETER:
            for node, parameters in (self._graph.parameters if self._graph is not None else {}).items():
                yield from (EntityId(kind, f"{node}/{name}") for name in parameters)
        yield from self.presences.ever(kind)

    def traits(self, entity: EntityId) -> Traits:
        """Return what selectors ask of an entity besides its name."""
        if entity.kind is EntityKind.CONNECTION:
            topic, publisher, subscriber = connection_ends(entity)
            host = self.host_of(EntityId(EntityKind.NODE, publisher))
            types = tuple(sorted(self._ends.get(topic, ((), ()))[1]))
            return Traits((host,), types, (publisher,), subscriber, topic)
        if entity.kind is EntityKind.TOPIC:
            publishers, types_ = self._ends.get(entity.name, (set[str](), set[str]()))
            hosts = {self.host_of(EntityId(EntityKind.NODE, node)) for node in publishers}
            return Traits(tuple(sorted(hosts)), tuple(sorted(types_)), tuple(sorted(publishers)), "", entity.name)
        return Traits((self.host_of(entity),), name=entity.name)

    def host_of(self, entity: EntityId) -> str:
        """Return the host on which something is or was; empty where that is unknown."""
        if entity.kind is EntityKind.HOST:
            return entity.name
        if entity.kind is EntityKind.PROCESS:
            return entity.name.rpartition("/")[0]
        if entity.kind is EntityKind.PARAMETER:
            node = max((name for name in self._parameters_of(entity)), key=len, default="")
            return self.presences.host_of(node)
        return self.presences.host_of(entity.name) if entity.kind is EntityKind.NODE else ""

    def lifecycle(self, node: EntityId) -> str:
        """Return the state of a managed node; empty where that is unknown."""
        if self.unseen(node):
            return ""
        return self.presences.lifecycle(node.name)

    def parameter(self, entity: EntityId) -> str | None:
        """Return the value of a parameter as text; None where that is unknown."""
        if self._graph is None or self.unseen(entity):
            return None
        for node in self._parameters_of(entity):
            return self._graph.parameters[node][entity.name[len(node) + 1 :]]
        return None

    def misfits(self, topic: str) -> int | None:
        """Return how many pairs of nodes exchange nothing over a topic; None where that is unknown."""
        return None if self._blind() else self._misfits.get(topic)

    def halted(self, node: EntityId, *, hung: bool) -> float | None:
        """Return since when a node is stopped, or hangs; None where it is not or that is unknown."""
        return self._halted.get((node, hung))

    def unseen(self, entity: EntityId) -> bool:
        """Whether who would have to see an entity is silent, or was just now."""
        if entity.kind is EntityKind.OBSERVER:
            return False
        host = self.host_of(entity)
        return self._blind() or (bool(host) and self._away(host, _SAMPLERS))

    def _blind(self) -> bool:
        return any(name.rpartition("/")[2] in _OF_GRAPH for name in self._silent) or any(
            name.rpartition("/")[2] in _OF_GRAPH and self.now - at < RETURNED_S for name, at in self._returned.items()
        )

    def _away(self, host: str, kinds: Iterable[str]) -> bool:
        names = [f"{host}/{kind}" for kind in kinds]
        return any(
            name in self._silent or self.now - self._returned.get(name, -RETURNED_S) < RETURNED_S for name in names
        )

    def _judged(self, verdict: Verdict) -> None:
        entity = verdict.entity
        if entity.kind is EntityKind.OBSERVER:
            if verdict.state is State.UNKNOWN:
                self._silent[entity.name] = self.now
            elif self._silent.pop(entity.name, None) is not None:
                self._returned[entity.name] = self.now
        mine = self._verdicts.get(entity)
        if mine is None:
            mine = self._verdicts[entity] = {}
            self.generation += 1
        if verdict.state is State.UNKNOWN and entity.kind in _FLEETING:
            # For what comes and goes, nothing without information is kept.
            mine.pop(verdict.expectation, None)
            if not any(one.verdict.state.bad for one in mine.values()):
                self._bad.discard(entity)
            return
        before = mine.get(verdict.expectation)
        same = before is not None and (before.verdict.state.bad, before.verdict.cause) == (
            verdict.state.bad,
            verdict.cause,
        )
        if verdict.state.bad:
            self._bad.add(entity)
        elif entity in self._bad and not any(
            one.verdict.state.bad for key, one in mine.items() if key != verdict.expectation
        ):
            self._bad.discard(entity)
        mine[verdict.expectation] = Held(verdict, before.settled_at if before is not None and same else self.now)

    def _take_graph(self, graph: Graph, now: float) -> None:
        self._graph = graph
        self.presences.take_graph(graph, now)
        self._misfits = misfits_by_topic(graph.endpoints, by_connection=graph.generation == "ros1")
        self._ends = {}
        for end in graph.endpoints:
            if end.role in (Role.PUBLISHER, Role.SUBSCRIPTION):
                publishers, types = self._ends.setdefault(end.name, (set(), set()))
                types.update(filter(None, (end.type,)))
                publishers.update((end.node,) if end.role is Role.PUBLISHER else ())

    def _parameters_of(self, entity: EntityId) -> Iterator[str]:
        """Yield the nodes that have a parameter of that name: `/a/b/c` is `c` of `/a/b`, or `b/c` of `/a`."""
        if self._graph is not None:
            at = entity.name.rfind("/")
            while at > 0:
                node = entity.name[:at]
                if entity.name[at + 1 :] in self._graph.parameters.get(node, ()):
                    yield node
                at = entity.name.rfind("/", 0, at)
