"""One difference between sides: the value of each, which is right, and why."""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.model.finding import Severity


class Aspect(str, Enum):
    """What of an entity differs."""

    PRESENCE = "presence"
    NAME = "name"
    PROGRAM = "program"
    TYPE = "type"
    RELIABILITY = "reliability"
    DURABILITY = "durability"
    LIVELINESS = "liveliness"
    DEADLINE = "deadline"
    LIFESPAN = "lifespan"
    LEASE = "lease"
    VALUE = "value"
    EXPECTED = "expected"


class Reason(str, Enum):
    """Why sides differ, as far as roslens can determine.

    - condition: it is there only under a condition, which a start decides
    - not_running: source starts it always, and it does not run
    - inactive: it is made when its managed node is configured or activated
    - remapped: the same under another name
    - other_launch: another launch file of the workspace starts it
    - not_launched: the workspace builds it, and no launch file compared starts it
    - unstarted: made by a library, plug-in or script that no known program starts
    - pattern: source knows only a part of the name
    - incomplete: source could not be read wholly there
    - tool: no part of the robot
    - guessed: source is not sure of it
    - not_recorded: a recording need not hold it
    - ignored: a parameter is set, and its node declares none of this name
    - set_otherwise: a value was set otherwise at the start or since
    - contradiction: one of the two is wrong
    - unknown_to_source: nothing in the workspace makes it
    - not_expected: a reference forbids it
    - missing: a reference expects it
    """

    CONDITION = "condition"
    NOT_RUNNING = "not_running"
    INACTIVE = "inactive"
    REMAPPED = "remapped"
    OTHER_LAUNCH = "other_launch"
    NOT_LAUNCHED = "not_launched"
    UNSTARTED = "unstarted"
    PATTERN = "pattern"
    INCOMPLETE = "incomplete"
    TOOL = "tool"
    GUESSED = "guessed"
    NOT_RECORDED = "not_recorded"
    IGNORED = "ignored"
    SET_OTHERWISE = "set_otherwise"
    CONTRADICTION = "contradiction"
    UNKNOWN_TO_SOURCE = "unknown_to_source"
    NOT_EXPECTED = "not_expected"
    MISSING = "missing"


ABSENT = "not there"
NOT_KNOWN = ""
"""The value of a side that cannot know."""


class Why(msgspec.Struct, frozen=True):
    """An explanation: its kind, the side that is right, a text, its severity, and a place in a file."""

    reason: Reason
    right: str
    text: str
    severity: Severity
    place: str = ""


class Disparity(msgspec.Struct, frozen=True):
    """One difference.

    Attributes:
        kind: of the entity: ``node``, the role of an endpoint, ``parameter`` or ``topic``.
        node: of which it is; empty of a topic.
        name: of the endpoint, parameter or topic; empty of a node.
        aspect: what of it differs.
        values: of each side, in their order: ``not there``, or empty for a side that cannot know.
        reason: why.
        right: the side that is right, in words.
        why: the explanation, as text.
        severity: a note is as it should be, or cannot be decided.
        place: in source or reference, as ``path:line``.
        also: how many endpoints and parameters go with a node that is not there.
    """

    kind: str
    node: str
    name: str
    aspect: Aspect
    values: tuple[str, ...]
    reason: Reason
    right: str
    why: str
    severity: Severity
    place: str = ""
    also: int = 0

    @property
    def subject(self) -> str:
        """Return what it is about, in words: ``publisher /scan of /lidar``."""
        kind = self.kind.replace("_", " ")
        if not self.name:
            return f"{kind} {self.node}"
        return f"{kind} {self.name} of {self.node}" if self.node else f"{kind} {self.name}"

    @property
    def order(self) -> tuple[int, str, bool, str, str, str]:
        """Return by what differences are sorted: the gravest first, then by node with itself before its parts."""
        return -self.severity.rank, self.node, bool(self.name), self.kind, self.name, self.aspect.value


class Conformance(msgspec.Struct, frozen=True):
    """All differences between sides.

    Attributes:
        titles: of the sides.
        kinds: of the sides: ``source``, ``running``, ``recording``, ``reference``.
        disparities: sorted, the gravest first.
        agreed: how many nodes, endpoints, parameters and topics at least two sides have in common.
        notes: what readers have to know of the comparison.
    """

    titles: tuple[str, ...]
    kinds: tuple[str, ...]
    disparities: tuple[Disparity, ...]
    agreed: dict[str, int]
    notes: tuple[str, ...] = ()

    def at_least(self, severity: Severity) -> tuple[Disparity, ...]:
        """Return the differences that are so grave or graver."""
        return tuple(one for one in self.disparities if one.severity.rank >= severity.rank)
