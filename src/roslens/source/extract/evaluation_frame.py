"""The names of a function while it is evaluated, and what it returned."""

from __future__ import annotations

from typing import Any

import msgspec

from roslens.source.extract.abstract_value import Made, Obj, Unknown, as_text
from roslens.source.extract.plain_methods import is_namespace
from roslens.source.extract.text import Hole, Text, unknown

Held = tuple[dict[str, Any], dict[str, Any]]
"""What names and members of the object hold."""


class WayOut(msgspec.Struct, frozen=True):
    """A place at which a loop or a turn of it is left.

    Attributes:
        conditions: all that are around it, outermost first.
        held: what names held there.
        again: whether only the turn is left.
    """

    conditions: tuple[str, ...]
    held: Held
    again: bool


class Ways:
    """The ways out of one loop.

    Attributes:
        depth: conditions around the loop.
        out: those that were found so far.
    """

    def __init__(self, depth: int) -> None:
        """Begin a loop with so many conditions around it."""
        self.depth = depth
        self.out: list[WayOut] = []


class Frame:
    """One call of a function.

    Attributes:
        path: of its file.
        scope: its qualified name, in which names are looked up.
        self: object it is called on; None of none.
        names: its parameters and variables.
        templates: what template parameters stand for.
        returned: whether it returned for sure.
        stopped: whether the turn of the loop around was left for sure.
        ways: out of the loop around; None outside of loops.
        result: what it returned.
        depth: conditions around the call, of which a return in it does not depend.
        passed: how many of the conditions hold because the function was not left before.
        plainly: whether the last return told no failure.
    """

    def __init__(self, path: str, scope: str, self_: Any = None, names: dict[str, Any] | None = None) -> None:
        self.path = path
        self.scope = scope
        self.self = self_
        self.names: dict[str, Any] = names if names is not None else {}
        self.templates: dict[str, str] = {}
        self.returned = False
        self.stopped = False
        self.ways: Ways | None = None
        self.result: Any = None
        self.depth = 0
        self.passed = 0
        self.plainly = False
        self._given = ""

    def give(self, value: Any, condition: str) -> None:
        """Return a value, under a condition that is open or for sure where that is empty."""
        self.result = self._or_else(value) if self._given else value
        self._given = condition or self._given or "always"
        self.returned = True

    def _or_else(self, value: Any) -> Any:
        """Return what is known where a function returns one value or another one."""
        before = self.result
        if _less(before, value):
            return value
        if isinstance(before, Text) and isinstance(value, Text) and value != before and value.parts:
            return _either(before, value, self._given)
        if isinstance(before, bool | int | float) and isinstance(value, bool | int | float) and value != before:
            return Unknown(f"one of {as_text(before)} and {as_text(value)}, by {self._given}")
        return before

    def snapshot(self) -> Held:
        """Return what names and members of the object hold."""
        return dict(self.names), dict(self.self.fields) if isinstance(self.self, Obj) else {}

    def restore(self, before: Held) -> None:
        """Put back what a snapshot holds."""
        self.names = dict(before[0])
        if isinstance(self.self, Obj):
            self.self.fields.clear()
            self.self.fields.update(before[1])

    def join(self, other: Held, condition: str) -> None:
        """Let hold what either way of a condition came to, ``other`` being that where it is true."""
        join(self.names, other[0], condition)
        if isinstance(self.self, Obj):
            join(self.self.fields, other[1], condition)


def _less(one: Any, other: Any) -> bool:
    """Whether a value says less than another one."""
    if one is None or isinstance(one, Unknown):
        return True
    return isinstance(one, Text) and isinstance(other, Text) and one.usual is None and other.usual is not None


def join(names: dict[str, Any], other: dict[str, Any], condition: str) -> None:
    """Let names hold what either way of a condition came to, ``other`` being what it is where it is true."""
    for name, value in other.items():
        before = names.get(name)
        if value == before:
            continue
        if before is None:
            names[name] = msgspec.structs.replace(value, certain=False) if isinstance(value, Made) else value
        elif isinstance(value, Unknown | Text | bool | int | float) and isinstance(
            before, Unknown | Text | bool | int | float
        ):
            names[name] = _one_of(value, before, condition)
        elif isinstance(before, Unknown):
            names[name] = value
        elif isinstance(before, Text) and value is not None:
            names[name] = _one_of(Unknown(as_text(value).holes[0].reason), before, condition)


def _one_of(value: Any, before: Any, condition: str) -> Any:
    """Return what is known of a value that is one thing where a condition holds, and another one else."""
    if isinstance(value, Text) and isinstance(before, Text):
        return _either(value, before, condition)
    if isinstance(value, Text) and isinstance(before, Unknown):
        return _either(value, unknown(before.reason), condition)
    if isinstance(before, Text) and isinstance(value, Unknown):
        return _either(unknown(value.reason), before, condition)
    reasons = [one.reason if isinstance(one, Unknown) else str(as_text(one)) for one in (value, before)]
    return Unknown(f"one of {reasons[0]} and {reasons[1]}, by {condition}"[:200])


def _but_for_slashes(one: Text, other: Text) -> Text | None:
    """Return the text with more separators where texts differ by one after a namespace only.

    A namespace ends with ``/`` only where it is nothing else; a name with two of them is tidied.
    """
    if not any(is_namespace(hole) for hole in one.holes):
        return None
    most = max(one, other, key=lambda text: len(text.pattern))
    least = other if most is one else one
    for place, part in enumerate(most.parts[:-1]):
        rest = most.parts[place + 1]
        if is_namespace(part) and isinstance(rest, str) and rest.startswith("/"):
            without = Text.of(*most.parts[: place + 1], rest[1:], *most.parts[place + 2 :])
            if without == least or Text.of("/", without) == least:
                return most
    return None


def _below(one: Text, other: Text, condition: str) -> Text | None:
    """Return a name that is below a namespace where it is relative: ``topic[0] != '/' ? ns + "/" + topic : topic``."""
    if len(other.parts) != 1 or len(one.parts) != 3 or one.parts[1] != "/" or one.parts[2] != other.parts[0]:
        return None
    space, name = one.parts[0], other.parts[0]
    if not isinstance(space, Hole) or not isinstance(name, Hole) or "/" not in condition:
        return None
    if not space.reason.startswith("namespace "):
        return None
    return Text((msgspec.structs.replace(name, below=space.reason),))


def _deciding(text: Text) -> list[str]:
    return [hole.parameter or hole.reason for hole in text.holes]


def _either(one: Text, other: Text, condition: str) -> Text:
    """Return the text that is one or the other; a known one counts for the usual."""
    if not one.parts:
        return other
    if not other.parts:
        return one
    if one.pattern == other.pattern and _deciding(one) == _deciding(other):
        return min(one, other, key=lambda text: len(str(text)))
    same = _but_for_slashes(one, other)
    if same is not None:
        return same
    below = _below(one, other, condition) or _below(other, one, condition)
    if below is not None:
        return below
    reason = f"{one} if {condition[:60]}, else {other}"
    parameter = next((hole.parameter for hole in (*one.holes, *other.holes) if hole.parameter), "")
    usual = other.usual if other.usual is not None else one.usual
    return Text((Hole(reason[:400], parameter, usual),))
