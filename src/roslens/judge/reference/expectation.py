"""What a reference expects of a live system: the values that its documents are read into."""

from __future__ import annotations

from enum import Enum
from typing import TypeVar

import msgspec

from roslens.judge.ranges.range import Range
from roslens.model.acting.reaction import Reaction
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.selector import Selector as Selector


class Timing(msgspec.Struct, frozen=True, omit_defaults=True):
    """How long something must last before it counts, in seconds.

    Attributes:
        lasting: a value must be bad this long before the verdict is (``for``).
        recovering: it must be fine this long before the verdict is ok again; 0 is as long as ``lasting``.
        margin: hysteresis as a share of the bound: a bad value counts as fine only when it is inside by that much.
        grace: after an entity appears, and after a clock jumps, nothing is bad for this long.
        window: over which values are taken; 0 lets roslens size it by the expected period.
    """

    lasting: float = 0.0
    recovering: float = 0.0
    margin: float = 0.0
    grace: float = 5.0
    window: float = 0.0


class Details(msgspec.Struct, frozen=True, omit_defaults=True):
    """What every constraint of a reference has besides what it expects.

    Attributes:
        id: ``<reference>.<name>``, unique.
        where: ``file:line`` of the constraint.
        severity: of its being broken.
        group: under which operators see it.
        text: message for the operator.
        timing: how long things must last.
    """

    id: str
    where: str = ""
    severity: Severity = Severity.WARNING
    group: str = ""
    text: str = ""
    timing: Timing = Timing()


class Expectation(msgspec.Struct, frozen=True, omit_defaults=True):
    """A signal of the selected entities is in a range; bounds are in the unit of the signal.

    ``percentile`` 0 takes the value of the window itself, else that share (of 100) of the values in it.
    ``written`` is the range as the document has it.
    """

    details: Details
    selector: Selector
    quantity: str
    range: Range
    written: str = ""
    percentile: float = 0.0


class PresenceMode(str, Enum):
    """How an entity has to be there."""

    ALWAYS = "always"
    AT_MOST_ONE = "at most one"
    NEVER = "never"
    WHILE = "while"
    ANY = "any"
    ANY_WHILE = "any while"


class End(str, Enum):
    """An end of a topic."""

    PUBLISHER = "publisher"
    SUBSCRIBER = "subscriber"


CONDITIONAL = (PresenceMode.WHILE, PresenceMode.ANY_WHILE)
"""Modes that ask for something only while another entity is there."""


class Presence(msgspec.Struct, frozen=True, omit_defaults=True):
    """Selected entities are there: always, while another is there, at most once each, or never.

    At most one node bears each name, serves each service or action, publishes each topic; of other kinds at most one is
    there that matches.

    With ``always`` and ``while`` each of the names that braces list must exist, and where one of them has wildcards,
    something that it matches; with ``any`` one that matches is enough. ``condition`` is the other entity of ``while``.
    A topic is there if it has the end that ``by`` names; ``never`` asks for neither.
    """

    details: Details
    selector: Selector
    mode: PresenceMode
    condition: Selector | None = None
    by: End = End.PUBLISHER


class FieldCondition(msgspec.Struct, frozen=True, omit_defaults=True):
    """A field of the last message on a topic is in a range; an empty topic is that of the check."""

    topic: str
    field: str
    range: Range


class FieldMeasure(str, Enum):
    """What of a field has to be in a range."""

    VALUE = "value"
    CHANGE = "change"
    DIFFERENCE = "difference"


class OtherField(msgspec.Struct, frozen=True):
    """A field to compare with; an empty topic is that of the check."""

    topic: str
    field: str


class FieldCheck(msgspec.Struct, frozen=True, omit_defaults=True):
    """A field of the messages of a topic is in a range, as long as a condition holds.

    Attributes:
        details: what goes with the constraint.
        topic: pattern of the topic.
        field: a path such as ``pose.position.x`` or ``ranges[0]``.
        range: of what is measured.
        written: the range as the document has it.
        condition: what enables it; None for always.
        measure: the value itself, its change since the message before, or how much more it is than ``other``.
        other: field whose newest value is subtracted; of a difference.
        type: pattern of the message type.
        without: patterns of topics that are left out.
    """

    details: Details
    topic: str
    field: str
    range: Range
    written: str = ""
    condition: FieldCondition | None = None
    measure: FieldMeasure = FieldMeasure.VALUE
    other: OtherField | None = None
    type: str = ""
    without: tuple[str, ...] = ()

    @property
    def selector(self) -> Selector:
        """The topics it is about."""
        return Selector(EntityKind.TOPIC, self.topic, type=self.type, without=self.without)


class AgeChain(msgspec.Struct, frozen=True, omit_defaults=True):
    """Data on the last of ``topics`` is at most so old, counted from its stamp on the first; seconds."""

    details: Details
    topics: tuple[str, ...]
    range: Range
    written: str = ""


class StateOf(str, Enum):
    """What of an entity is reported as text."""

    LIFECYCLE = "lifecycle"
    VALUE = "value"


class StateCheck(msgspec.Struct, frozen=True, omit_defaults=True):
    """The lifecycle state of managed nodes, or the value of parameters, is one of those allowed, or in a range.

    Attributes:
        details: what goes with the constraint.
        selector: nodes of a lifecycle, parameters of a value.
        of: which of the two.
        allowed: texts that are fine; numbers are compared as numbers.
        range: of numbers that are fine; None where ``allowed`` says it.
        written: both as the document has them.
    """

    details: Details
    selector: Selector
    of: StateOf
    allowed: tuple[str, ...] = ()
    range: Range | None = None
    written: str = ""


class Reference(msgspec.Struct, frozen=True, omit_defaults=True):
    """Everything that is expected of a system, and what is done where it is not so, merged from its documents.

    Each part is sorted by id.
    """

    name: str
    title: str = ""
    documents: tuple[str, ...] = ()
    expectations: tuple[Expectation, ...] = ()
    presences: tuple[Presence, ...] = ()
    field_checks: tuple[FieldCheck, ...] = ()
    chains: tuple[AgeChain, ...] = ()
    states: tuple[StateCheck, ...] = ()
    reactions: tuple[Reaction, ...] = ()


AnyConstraint = TypeVar("AnyConstraint", Expectation, Presence, FieldCheck, AgeChain, StateCheck)


def essence(constraint: AnyConstraint) -> AnyConstraint:
    """Return a constraint without what is only reported of it: two with the same essence expect the same."""
    details = Details(constraint.details.id, timing=constraint.details.timing)
    return msgspec.structs.replace(constraint, details=details)
