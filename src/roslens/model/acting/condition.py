"""What has to be the case before something is done: a tree over what is held of a system, and over time.

A condition is true, false or unknown. ``not`` of unknown is unknown, ``all`` is false where one part is false and else
unknown where one is, ``any`` the other way round: Kleene's strong three-valued logic. Only what is true is acted upon.
"""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.model.finding import Severity
from roslens.model.selector import Selector


class About(str, Enum):
    """What a statement requires of the selected entities.

    - verdict: how a constraint of the reference judges them; its states are those of ``model.verdict.State``, ``bad``
      (low, high or absent) and ``wrong`` (bad, or an observer of which nothing is heard)
    - being: what they are to the graph and the operating system, with a constraint about it or without; its states
      are those of ``Being``
    - lifecycle: the state of managed nodes
    - value: the value of parameters
    """

    VERDICT = "verdict"
    BEING = "being"
    LIFECYCLE = "lifecycle"
    VALUE = "value"


class Being(str, Enum):
    """What can be said of an entity without a constraint of the reference.

    ``gone`` was there and is not any more; ``crashed`` went with its process, which nobody had asked to end;
    ``stopped`` and ``hung`` are what its process is; ``misfit`` is a topic of which two ends exchange nothing.
    """

    THERE = "there"
    GONE = "gone"
    CRASHED = "crashed"
    RESTARTED = "restarted"
    FLAPPING = "flapping"
    STOPPED = "stopped"
    HUNG = "hung"
    MISFIT = "misfit"


class Matching(str, Enum):
    """How many of the selected entities it takes: one, all that are known, or each on its own."""

    ANY = "any"
    ALL = "all"
    EACH = "each"


class OverTime(msgspec.Struct, frozen=True, omit_defaults=True):
    """What time adds to a condition; all of it has to hold. Seconds.

    Attributes:
        for_s: it has been true for so long without a break.
        within_s: it became true at most so long before or after ``of`` did; what is that long ago is still so for
            ``within_s``.
        of: the other condition; None without ``within_s``.
        after_start_s: the monitor has watched for so long.
    """

    for_s: float = 0.0
    within_s: float = 0.0
    of: Condition | None = None
    after_start_s: float = 0.0


NO_TIME = OverTime()


class Stated(msgspec.Struct, frozen=True, omit_defaults=True, tag="stated"):
    """Selected entities are in one of some states.

    Attributes:
        selector: of the entities.
        about: what is said of them.
        states: of which one has to hold: of a verdict, of a being, of a lifecycle, or values of a parameter.
        quantity: of a verdict, the key of the signal; empty for whichever.
        severity: of a verdict that is bad, the least that counts.
        least: of a parameter, the smallest number that counts; None for none. It takes the place of ``states``.
        most: the greatest number that counts.
        matching: how many of the selected it takes.
        effects: whether faults count that another fault explains; else only first causes do.
        unknown: what unknown is taken for; None leaves it unknown.
        time: what time adds.
        place: ``file:line:column``.
        written: the statement in words.
    """

    selector: Selector
    about: About = About.VERDICT
    states: tuple[str, ...] = ()
    quantity: str = ""
    severity: Severity = Severity.NOTE
    least: float | None = None
    most: float | None = None
    matching: Matching = Matching.ANY
    effects: bool = False
    unknown: bool | None = None
    time: OverTime = NO_TIME
    place: str = ""
    written: str = ""


class AllOf(msgspec.Struct, frozen=True, omit_defaults=True, tag="all"):
    """Every part is true."""

    parts: tuple[Condition, ...]
    time: OverTime = NO_TIME
    place: str = ""


class AnyOf(msgspec.Struct, frozen=True, omit_defaults=True, tag="any"):
    """One part is true."""

    parts: tuple[Condition, ...]
    time: OverTime = NO_TIME
    place: str = ""


class AtLeast(msgspec.Struct, frozen=True, omit_defaults=True, tag="at_least"):
    """So many parts are true."""

    count: int
    parts: tuple[Condition, ...]
    time: OverTime = NO_TIME
    place: str = ""


class Not(msgspec.Struct, frozen=True, omit_defaults=True, tag="not"):
    """The part is false."""

    part: Condition
    time: OverTime = NO_TIME
    place: str = ""


Condition = Stated | AllOf | AnyOf | AtLeast | Not
