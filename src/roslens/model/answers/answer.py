"""One ordered answer to the question why an entity does not do what it should; first what is certain."""

from __future__ import annotations

from enum import Enum

import msgspec


class StepState(str, Enum):
    """How a step of an answer came out.

    - ok: it is as it should be
    - not: it is not, and so is a cause
    - unseen: what was looked at cannot tell; the step says how to see it
    """

    OK = "ok"
    NOT = "not"
    UNSEEN = "cannot be seen"


class Asks(str, Enum):
    """What a step asks, in the order in which an answer goes through them."""

    EXISTS = "exists"
    MADE = "made by"
    USED = "used by"
    RUNS = "running"
    REACHED = "reachable"
    TYPE = "type"
    QOS = "QoS"
    INPUTS = "inputs"
    TREE = "tree"
    SENT = "sent"
    RECEIVED = "received"
    AGE = "age"
    LAST_GOOD = "last good"
    RULES = "rules"


_ORDER = {one: place for place, one in enumerate(Asks)}


class Step(msgspec.Struct, frozen=True, omit_defaults=True):
    """One step of an answer.

    Attributes:
        asks: which question it is about.
        state: how it came out.
        says: the result in a sentence.
        of: what was looked at: ``source``, ``recording`` or ``live``.
        evidence: what shows it, a line each; places as ``path:line``.
        how: how to see what cannot be seen, or what to do about it; empty where nothing is to do.
        command: a command line to try; empty where there is none.
    """

    asks: Asks
    state: StepState
    says: str
    of: str
    evidence: tuple[str, ...] = ()
    how: str = ""
    command: str = ""

    @property
    def order(self) -> int:
        """Its place in an answer."""
        return _ORDER[self.asks]


class Answer(msgspec.Struct, frozen=True, omit_defaults=True):
    """All steps about an entity.

    Attributes:
        entity: text form of its id.
        looked_at: what was looked at, a line each.
        steps: in order.
        notes: what was not looked at and why, a sentence each.
        version: of this form.
    """

    entity: str
    looked_at: tuple[str, ...]
    steps: tuple[Step, ...]
    notes: tuple[str, ...] = ()
    version: int = 1

    @property
    def cause(self) -> Step | None:
        """The first cause: the first step that is not as it should be; None where all are."""
        return next((one for one in self.steps if one.state is StepState.NOT), None)


def in_order(steps: tuple[Step, ...]) -> tuple[Step, ...]:
    """Return steps in the order of an answer; those of one question stay as they were."""
    return tuple(sorted(steps, key=lambda one: one.order))
