"""Nodes that are gone or stopped, as the first cause of what is wrong, whether or not a constraint is about that."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from roslens.judge.reference.expectation import Details
from roslens.live.standing.standing import Standing
from roslens.live.standing.verdict_state import NEVER
from roslens.live.system.world import World
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.verdict import State

GONE = Details("roslens.gone")
STOPPED = Details("roslens.stopped")
LEFT_S = 10.0
"""A publisher that left explains what went wrong with a topic that others publish on within so many seconds."""
LASTING_S = 60.0
"""What begins so long after a node left does not follow from that: no window is longer."""
_SHOWN = 3


class NodeFault(Standing):
    """That a node is gone or stopped: reported while it explains something that is wrong."""

    __slots__ = ()

    def __init__(self, node: EntityId, details: Details, since: float, now: float) -> None:
        gone = details.id == GONE.id
        super().__init__(node, details, "presence" if gone else "stopped", "", since)
        self.state.forget(since, State.ABSENT if gone else State.HIGH)
        self.state.since, self.state.time = since, now
        self.state.due = NEVER
        self.evidence = "is gone" if gone else "is stopped"

    def end(self, now: float, *, there: bool) -> None:
        """Be so no more, or explain nothing any more."""
        self.state.forget(now, State.OK if there else State.UNKNOWN)
        self.state.since = self.state.time = now
        self.state.due = NEVER
        self.evidence = "runs again" if there else "explains nothing that is wrong"


def chain_of(world: World, followers: Iterable[EntityId], state_of: Mapping[EntityId, State]) -> str:
    """Return what a fault leads to: ``/scan silent → /planner without input``."""
    topics = sorted({one.name for one in followers if one.kind is EntityKind.TOPIC})
    absent = [name for name in topics if state_of.get(EntityId(EntityKind.TOPIC, name)) is State.ABSENT]
    silent = [name for name in topics if name in absent or _abandoned(world, name)]
    starved = sorted({node for name in silent for node in _readers(world, name)})
    slow = [name for name in topics if name not in silent]
    parts = [f"{_named(silent)} silent"] if silent else []
    parts += [f"{_named(starved)} without input"] if starved else []
    parts += [f"{_named(slow)} wrong"] if slow else []
    return " → ".join(parts)


def _abandoned(world: World, topic: str) -> bool:
    known = world.topics.get(topic)
    return known is not None and not known.publishers and bool(known.former)


def _readers(world: World, topic: str) -> frozenset[str]:
    known = world.topics.get(topic)
    return known.subscribers if known is not None else frozenset()


def _named(names: list[str]) -> str:
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return ", ".join(names[:_SHOWN]) + more


def severity_of(severities: Iterable[Severity]) -> Severity:
    """Return the gravest; a fault matters as much as the worst of what it leads to."""
    return max(severities, key=lambda one: one.rank, default=Severity.WARNING)
