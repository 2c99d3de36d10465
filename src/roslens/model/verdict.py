"""What is held of one quantity of one entity, judged against one constraint of a reference."""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity


class State(str, Enum):
    """How an entity stands, from best known to worst.

    ``unknown``: there is no value to judge. ``suspended``: time stands still or jumped, or its enabling condition does
    not hold. ``absent``: it should be there, or should have said something, and is not or has not.
    """

    OK = "ok"
    SUSPENDED = "suspended"
    UNKNOWN = "unknown"
    LOW = "low"
    HIGH = "high"
    ABSENT = "absent"

    @property
    def judged(self) -> bool:
        """Whether there was a value, or none where one should be."""
        return self not in (State.UNKNOWN, State.SUSPENDED)

    @property
    def bad(self) -> bool:
        """Whether it is an alarm."""
        return self in (State.LOW, State.HIGH, State.ABSENT)


class Link(msgspec.Struct, frozen=True, omit_defaults=True):
    """One step from a fault to its first cause.

    Attributes:
        entity: text form of the id of what is a step nearer to the cause.
        relation: what the one before has to do with it: ``is published by``, ``runs on``…
        evidence: what is wrong with it; empty where nothing is, and it only hands on what it does not get.
    """

    entity: str
    relation: str
    evidence: str = ""


class Verdict(msgspec.Struct, frozen=True, omit_defaults=True):
    """The verdict of one expectation on one entity, from ``since`` on.

    Attributes:
        entity: judged.
        expectation: id of the constraint, ``<reference>.<id>``.
        quantity: key of the signal; ``presence`` where being there is what is judged.
        state: how it stands.
        since: seconds on the monitor's clock at which the state began, that is, when the fault began and not when
            it had lasted long enough.
        time: when this was judged.
        value: that was judged, in the unit of the signal; None where there is none.
        range: the values that are fine, as the reference writes them.
        severity: of its being bad.
        evidence: what shows it, in words: window, messages, observer.
        text: message for the operator.
        group: under which operators see it.
        where: ``file:line`` of the constraint.
        cause: text form of the id of the entity whose fault explains this one; empty for a first cause. Of what is
            unknown it is the observer of which nothing is heard.
        leads_to: of a first cause what follows from it: ``/scan silent → /planner without input``.
        why: the way to the cause, link by link; empty for a first cause.
    """

    entity: EntityId
    expectation: str
    quantity: str
    state: State
    since: float
    time: float
    value: float | None = None
    range: str = ""
    severity: Severity = Severity.WARNING
    evidence: str = ""
    text: str = ""
    group: str = ""
    where: str = ""
    cause: str = ""
    leads_to: str = ""
    why: tuple[Link, ...] = ()

    @property
    def of_observer(self) -> bool:
        """Whether it is about an observer: unknown while the observer is silent."""
        return self.entity.kind is EntityKind.OBSERVER

    @property
    def wrong(self) -> bool:
        """Whether it needs attention: an alarm, or a silent observer."""
        return self.state.bad or (self.of_observer and self.state is State.UNKNOWN)
