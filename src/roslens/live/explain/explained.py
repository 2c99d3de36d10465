"""The verdicts that are bad at this moment, each with the fault that explains it."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Mapping

import msgspec

from roslens.live.explain.blame import TIMES, only_clock, why_host
from roslens.live.explain.causes import first_causes
from roslens.live.explain.links import links
from roslens.live.explain.node_faults import GONE, LASTING_S, LEFT_S, STOPPED, NodeFault, chain_of, severity_of
from roslens.live.explain.taken_over import taken_over
from roslens.live.explain.what_explains import is_halted, is_inert, may_explain
from roslens.live.standing.standing import Standing
from roslens.live.system.world import World
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.verdict import State

_GRAVEST = Severity.ERROR.rank + 1
"""A node that is gone or stopped is a fact: nothing that was measured of its host explains it."""


class Explained:
    """Keeps the bad verdicts, and looks for their causes again when these or the graph changed."""

    def __init__(self, world: World, gone: Callable[[], Mapping[EntityId, float]]) -> None:
        """Explain what is wrong with ``world``; ``gone`` are nodes that are not there any more, and since when."""
        self._world = world
        self._gone = gone
        self._bad: set[Standing] = set()
        self._faults: dict[EntityId, NodeFault] = {}
        self._wrong: dict[EntityId, list[Standing]] = {}
        self.stale = False

    @property
    def faults(self) -> Iterable[NodeFault]:
        """The nodes that are gone or stopped, and that explain something."""
        return self._faults.values()

    def note(self, one: Standing) -> None:
        """Take a verdict that changed."""
        if one.state.state.bad:
            self._bad.add(one)
            self.stale = True
        elif one in self._bad:
            self.drop(one)

    def drop(self, one: Standing) -> None:
        """Forget a verdict."""
        if one in self._bad:
            self._bad.remove(one)
            one.cause = one.leads_to = ""
            one.why = ()
            self.stale = True

    def explain(self, now: float) -> list[Standing]:
        """Give each bad verdict its cause; return those of which it changed, and the nodes that are to blame."""
        if not self.stale:
            return []
        self.stale = False
        since: dict[EntityId, float] = {}
        weights: dict[EntityId, int] = {}
        for one in self._bad:
            since[one.entity] = min(since.get(one.entity, one.state.since), one.state.since)
            weights[one.entity] = max(weights.get(one.entity, 0), one.details.severity.rank)
        gone = dict(self._gone()) if self._bad else {}
        stopped = dict(self._world.stopped(now)) if self._bad else {}
        for node, at in (*gone.items(), *stopped.items()):
            since[node] = min(since.get(node, at), at)
            weights[node] = _GRAVEST
        until = {node: at + LASTING_S for node, at in gone.items()}
        self._wrong = {}
        for one in self._bad:
            self._wrong.setdefault(one.entity, []).append(one)
        for entity, wrong in self._wrong.items():
            if entity.kind is EntityKind.NODE and entity not in gone and entity not in stopped and is_inert(wrong):
                del since[entity]

        absent = {one.entity for one in self._bad if one.state.state is State.ABSENT}
        asked: dict[EntityId, tuple[EntityId, ...]] = {}

        def upstream(entity: EntityId) -> tuple[EntityId, ...]:
            if entity not in asked:
                asked[entity] = tuple(self._upstream(entity, since, gone, absent, now))
            return asked[entity]

        def evidence(before: EntityId, entity: EntityId) -> str:
            return self._evidence(before, entity, gone, stopped, now)

        faulty = {**stopped, **gone}
        causes = first_causes(since, self._fine, upstream, weights, until)
        causes = {entity: cause for entity, cause in causes.items() if self._can_break(cause, entity)}
        causes = taken_over(causes, since, faulty, self._world)
        changed = self._reported(causes, upstream, evidence)
        changed += self._blamed(causes, faulty, gone, now)
        self._lead(causes)
        return changed

    def _reported(
        self,
        causes: Mapping[EntityId, EntityId],
        upstream: Callable[[EntityId], Iterable[EntityId]],
        evidence: Callable[[EntityId, EntityId], str],
    ) -> list[Standing]:
        changed = []
        for one in self._bad:
            known = causes.get(one.entity)
            cause = str(known) if known is not None else ""
            if cause != one.cause:
                one.cause, one.why = cause, ()
                changed.append(one)
        ways = links({one.entity: causes[one.entity] for one in changed if one.cause}, upstream, evidence)
        for one in changed:
            one.why = ways.get(one.entity, ())
        return changed

    def _can_break(self, cause: EntityId, fault: EntityId) -> bool:
        """Whether a cause can break what is wrong: a clock can make times wrong, and nothing else."""
        if not may_explain(self._wrong.get(cause, ()), self._wrong.get(fault, ()), cause.kind):
            return False
        if cause.kind is not EntityKind.HOST or not only_clock(self._wrong.get(cause, ())):
            return True
        return all(one.quantity in TIMES for one in self._wrong.get(fault, ()))

    def _evidence(
        self,
        before: EntityId,
        entity: EntityId,
        gone: Mapping[EntityId, float],
        stopped: Mapping[EntityId, float],
        now: float,
    ) -> str:
        """Return what is wrong with an entity, as far as what depends on it is concerned."""
        if entity in gone:
            return "is gone"
        if entity in stopped:
            return "is stopped"
        if entity.kind is EntityKind.HOST:
            return why_host(self._wrong.get(entity, ()), before, self._world, now)
        standing = sorted(self._wrong.get(entity, ()), key=lambda one: (-one.details.severity.rank, one.details.id))
        return f"{standing[0].quantity} is {standing[0].state.state.value}" if standing else ""

    def _blamed(
        self,
        causes: Mapping[EntityId, EntityId],
        faulty: Mapping[EntityId, float],
        gone: Iterable[EntityId],
        now: float,
    ) -> list[Standing]:
        """Start and end faults of nodes that are gone or stopped and that no constraint covers."""
        judged = {one.entity for one in self._bad if one.quantity in ("presence", "stopped")}
        blamed = {cause for cause in causes.values() if cause in faulty and cause not in judged}
        gravity: dict[EntityId, list[Severity]] = {}
        for one in self._bad:
            if one.entity in causes:
                gravity.setdefault(causes[one.entity], []).append(one.details.severity)
        changed: list[Standing] = []
        for node in sorted(blamed):
            details = msgspec.structs.replace(
                GONE if node in gone else STOPPED, severity=severity_of(gravity.get(node, ()))
            )
            fault = self._faults.get(node)
            if fault is None or fault.details.id != details.id:
                fault = self._faults[node] = NodeFault(node, details, faulty[node], now)
                changed.append(fault)
            fault.details = details
        for node in sorted(self._faults.keys() - blamed):
            fault = self._faults.pop(node)
            fault.leads_to = ""
            fault.end(now, there=node not in faulty)
            changed.append(fault)
        return changed

    def _lead(self, causes: Mapping[EntityId, EntityId]) -> None:
        """Add the effects of each first cause."""
        followers: dict[EntityId, list[EntityId]] = {}
        for entity, cause in causes.items():
            followers.setdefault(cause, []).append(entity)
        states: dict[EntityId, State] = {}
        for one in self._bad:
            if states.get(one.entity) is not State.ABSENT:
                states[one.entity] = one.state.state
        for one in (*self._bad, *self._faults.values()):
            # That nothing comes on a topic starves who reads it; anything else of it is the fault itself.
            silent = one.entity.kind is EntityKind.TOPIC and states.get(one.entity) is State.ABSENT
            own = [one.entity] if silent else []
            first = one.entity in followers and one.entity not in causes
            one.leads_to = chain_of(self._world, [*own, *followers[one.entity]], states) if first else ""

    def _upstream(
        self,
        entity: EntityId,
        since: Mapping[EntityId, float],
        gone: Mapping[EntityId, float],
        absent: Container[EntityId],
        now: float,
    ) -> Iterator[EntityId]:
        """Yield what an entity depends on, as far as that may explain what is wrong with it."""
        for one in self._world.upstream(entity):
            faults = self._wrong.get(one) if one.kind is EntityKind.HOST else None
            if faults and not why_host(faults, entity, self._world, now):
                continue
            if entity in gone and one not in absent:
                continue
            if one.kind is EntityKind.TOPIC and is_halted(self._wrong.get(entity, ())):
                continue
            if entity.kind is EntityKind.TOPIC and one in gone and not self._left_lately(entity, one, since, gone):
                continue
            yield one

    def _left_lately(
        self, topic: EntityId, node: EntityId, since: Mapping[EntityId, float], gone: Mapping[EntityId, float]
    ) -> bool:
        """Whether a node that is gone may be the cause of a bad topic: it was the only publisher, or has just left."""
        known = self._world.topics.get(topic.name)
        if known is not None and not known.publishers:
            return node.name in known.former
        return topic in since and abs(since[topic] - gone[node]) <= LEFT_S

    def _fine(self, entity: EntityId) -> bool:
        if entity.kind is not EntityKind.TOPIC:
            return False
        topic = self._world.topics.get(entity.name)
        if topic is None or not topic.judged:
            return False
        return all(one.state.state is State.OK for one in topic.judged)
