"""The names of a function while it is evaluated, and what it returned."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from operator import is_
from types import MappingProxyType

import msgspec

from roslens.source.extract.domain.abstract_value import Class, Made, Named, Names, Obj, Unknown, Value, as_text
from roslens.source.extract.domain.disjuncts import one_object
from roslens.source.extract.domain.guarded import guarded
from roslens.source.extract.domain.kinds import all_of_kind, has_kind, items_of, object_of, reason_of
from roslens.source.extract.domain.quality import one_of as one_quality
from roslens.source.extract.domain.text_choice import either
from roslens.source.extract.ir.program import Expression, Function
from roslens.source.extract.symbolic.condition import ALWAYS, all_of, any_of, negated
from roslens.source.extract.symbolic.text import (
    And,
    Condition,
    Conditions,
    Or,
    Text,
)

Held = tuple[Names, Names]
"""What names and members of the object hold."""


_PLAIN = frozenset({Unknown, Text, bool, int, float})
_NONE: dict[str, tuple[object, ...]] = {}
"""Kept variables of most functions; it is never changed."""


class LoopExit(msgspec.Struct, frozen=True):
    """A place at which a loop or a turn of it is left.

    Attributes:
        conditions: all that are around it, outermost first.
        turn: how many of them were around the turn.
        held: what names held there.
        again: whether only the turn is left.
    """

    conditions: Conditions
    turn: int
    held: Held
    again: bool


class PendingExits:
    """The ways out of one loop.

    Attributes:
        turn: conditions around the turn that is followed.
        out: those that were found so far.
    """

    def __init__(self, depth: int) -> None:
        """Begin a loop with so many conditions around it."""
        self.turn = depth
        self.out: list[LoopExit] = []


class Frame:
    """One call of a function.

    Attributes:
        path: of its file.
        scope: its qualified name, in which names are looked up.
        self: what it is called on; None of nothing.
        object: that where it is one; None of none.
        members: what the members of the object hold; None of none.
        names: its parameters and variables.
        templates: what template parameters stand for.
        returned: whether it returned for sure.
        stopped: whether the turn of the loop around was left for sure.
        ways: out of the loop around; None outside of loops.
        broken: whether the last loop was left by ``break``; None where that depends.
        result: what it returned.
        depth: conditions around the call, of which a return in it does not depend.
        passed: how many of the conditions hold because the function was not left before.
        plainly: whether the last return reported no failure.
        tests: what decides the conditions of branches, where that is known.
        kept: variables that live on between calls, and their places.
        left: what ways that left the function changed in members of the object, and their conditions.
    """

    aliases: Mapping[str, tuple[Expression, bool]] = MappingProxyType({})
    """Other names of plain values: what they are names of, and whether they point to it."""

    def __init__(self, path: str, scope: str, self_: Value = None, names: Names | None = None) -> None:
        self.path = path
        self.scope = scope
        self.self = self_
        self.object = object_of(self_)
        self.members = None if self.object is None else self.object.fields
        self.names: Names = names if names is not None else {}
        self.templates: dict[str, str] = {}
        self.returned = False
        self.stopped = False
        self.ways: PendingExits | None = None
        self.broken: bool | None = None
        self.result: Value = None
        self.depth = 0
        self.passed = 0
        self.plainly = False
        self.tests: dict[Condition, Condition] = {}
        self.kept: dict[str, tuple[object, ...]] = _NONE
        self.left: list[tuple[Names, Condition]] = []
        self._given: Condition | None = None
        self._given_test: Condition | None = None

    def give(self, value: Value, conditions: Sequence[Condition] = ()) -> None:
        """Return a value, under conditions that are open or for sure where there are none."""
        self.result = value if self._given is None else self._or_else(value, self._given)
        if conditions:
            condition, test = all_of(conditions), self.test_of(conditions)
            if self._given is not None:
                # What was returned until now is returned where either condition holds, whatever comes next.
                condition = any_of(self._given, condition)
                both = None if test is None else self._given_test
                test = None if both is None or test is None else Or((both, test))
            self._given, self._given_test = condition, test
        elif self._given is None:
            self._given = ALWAYS
        self.returned = True

    def as_returned(self, value: Value, *, open_: bool) -> Value:  # noqa: ARG002 - frames of launch files ask
        """Return a value as it is where the function returns it, under a condition or not."""
        return value

    def outcome(self) -> Value:
        """Return what the call returned, which is None where its end was reached, and may be where it may have been."""
        if not self.returned and self._given is not None:
            self.result = self._or_else(None, self._given)
        return self.result

    def know(self, condition: Condition, otherwise: Condition, test: Condition | None) -> None:
        """Remember what decides a condition and its opposite."""
        if test is not None:
            self.tests[condition], self.tests[otherwise] = test, negated(test)
        else:
            self.tests.pop(condition, None)
            self.tests.pop(otherwise, None)

    def test_of(self, conditions: Sequence[Condition]) -> Condition | None:
        """Return what decides whether all of several conditions hold; None where that is not known of each."""
        tests = [self.tests[one] for one in conditions if one in self.tests]
        if not tests or len(tests) < len(conditions):
            return None
        return tests[0] if len(tests) == 1 else And(tuple(tests))

    def _or_else(self, value: Value, given: Condition) -> Value:
        """Return what is known where a function returns one value or another one."""
        before = self.result
        if before is None or value is None:
            return one_or_none(before, value, given, self._given_test)
        match before, value:
            case Unknown(), Unknown():
                return before
            case Text() | Unknown(), Text() | Unknown():
                return either(as_text(before), as_text(value), given, self._given_test)
        both = one_of(before, value, given, self._given_test)
        if both is not None:
            return both
        match before, value:
            case (Unknown() | bool() | int() | float(), Unknown() | bool() | int() | float()) if value != before:
                return Unknown(f"one of {as_text(before)} and {as_text(value)}, by {given}")
            case Unknown(), _:
                return value
        return before

    def snapshot(self) -> Held:
        """Return what names and members of the object hold."""
        return dict(self.names), dict(self.members or {})

    def leave(self, fields: Names, before: Names, condition: Condition) -> None:
        """Remember what members of the object a way that leaves the function came to, for when it has ended."""
        changed = {name: value for name, value in fields.items() if before.get(name) is not value}
        if changed:
            self.left.append((changed, condition))

    def is_as(self, before: Held) -> bool:
        """Return whether names and members hold the very same as a snapshot: order and all."""
        names, held = self.names, before[0]
        if len(names) != len(held) or not all(map(is_, names.values(), held.values())):
            return False
        fields, held = self.members or {}, before[1]
        return len(fields) == len(held) and all(map(is_, fields.values(), held.values()))

    def restore(self, before: Held) -> None:
        """Put back what a snapshot holds."""
        # Lambdas that were made meanwhile see the names as they are when they are called.
        names = self.names
        names.clear()
        names |= before[0]
        if self.members is not None:
            self.members.clear()
            self.members |= before[1]

    def join(self, other: Held, condition: Condition) -> None:
        """Let hold what either way of a condition came to, ``other`` being that where it is true."""
        test = self.tests.get(condition)
        join(self.names, other[0], condition, test)
        if self.members is not None:
            join(self.members, other[1], condition, test)


def join(names: Names, other: Names, condition: Condition, test: Condition | None = None) -> None:
    """Let names hold what either way of a condition came to, ``other`` being what it is where it is true."""
    known = names.get
    for name, value in [item for item in other.items() if known(item[0]) is not item[1]]:
        before = known(name)
        if value == before:
            continue
        if before is None and name in names:
            names[name] = one_or_none(value, before, condition, test)
        elif before is None:
            names[name] = _perhaps_made(value)
        else:
            names[name] = _joined(value, before, condition, test)


def _joined(value: Value, before: Value, condition: Condition, test: Condition | None) -> Value:
    """Return what a name holds that held something before, and holds ``value`` where a condition is true."""
    plain = type(before) in _PLAIN
    if value is None and plain:
        return one_or_none(value, before, condition, test)
    both = one_of(value, before, condition, test)
    if both is not None:
        return both
    if plain and type(value) in _PLAIN:
        return _one_of(value, before, condition, test)
    match before:
        case Unknown():
            return value
        case Text():
            return _one_of(Unknown(as_text(value).holes[0].reason), before, condition, test)
    return before


def _perhaps_made(value: Value) -> Value:
    """Return what is there, an endpoint perhaps not for sure."""
    match value:
        case Made():
            return msgspec.structs.replace(value, certain=False)
    return value


def one_or_none(value: Value, other: Value, condition: Condition, test: Condition | None = None) -> Value:
    """Return what is known of two values of which one is None: of a text that it may be missing.

    Of an object it is taken that it is there where it is used; an endpoint is there, but perhaps not for sure.
    """
    found = other if value is None else value
    match found:
        case Text():
            return either(Text() if value is None else found, Text() if other is None else found, condition, test)
        case Unknown() | bool() | int() | float():
            return Unknown(f"{as_text(found)} or nothing, by {condition}"[:200])
    return _perhaps_made(found)


def one_of(value: Value, other: Value, condition: Condition, test: Condition | None = None) -> Value:
    """Return what is known of two values that are no texts, of which a condition chooses; None where either may stand.

    Which object of one class or of ROS it is makes no difference in most code: the first one stands for both.
    """
    quality = one_quality(value, other, condition)
    if quality is not None:
        return quality
    match value:
        case list():
            return _one_of_list(value, other, condition, test)
        case Unknown():
            return value if has_kind(items_of(other), Text) else None
        case Obj():
            second = object_of(other)
            return None if second is None else one_object(value, second, condition)
        case Named() | Class():
            match other:
                case Named() | Class() if value.name != other.name:
                    return Unknown(f"one of {value.name} and {other.name}, by {condition}"[:200])
    return None


def _one_of_list(value: list[Value], other: Value, condition: Condition, test: Condition | None) -> Value:
    match other:
        case list():
            return _one_list(value, other, condition, test)
        case Unknown():
            return other if has_kind(value, Text) else None
    return None


def _one_list(value: list[Value], other: list[Value], condition: Condition, test: Condition | None) -> Value:
    """Return the longer list where one goes on where the other ends, as one that is filled does."""
    less, more = sorted((value, other), key=len)
    if more[: len(less)] == less:
        filled = more is value
        opposite = None if test is None else negated(test)
        rest = guarded(more[len(less) :], condition if filled else negated(condition), test if filled else opposite)
        return [*less, *rest]
    if not has_kind((*less, *more), Text):
        return None
    first, second = all_of_kind(value, Text), all_of_kind(other, Text)
    if len(less) < len(more) or len(first) < len(value) or len(second) < len(other):
        return Unknown(f"one of two lists, by {condition}"[:200])
    return [either(one, two, condition, test) for one, two in zip(first, second, strict=True)]


def _one_of(value: Value, before: Value, condition: Condition, test: Condition | None) -> Value:
    """Return what is known of a value that is one thing where a condition holds, and another one else."""
    match value, before:
        case (Text(), Text() | Unknown()) | (Unknown(), Text()):
            return either(as_text(value), as_text(before), condition, test)
    reasons = [str(reason_of(one, str(as_text(one)))) for one in (value, before)]
    return Unknown(f"one of {reasons[0]} and {reasons[1]}, by {condition}"[:200])


def bind_rest(what: Function, place: int, arguments: list[Value], keywords: Names, frame: Frame) -> None:
    """Give ``*args`` or ``**options`` of a function of Python what no other parameter takes."""
    name = what.parameters[place].name
    if name.startswith("**"):
        named = {one.name for one in what.parameters}
        frame.names[name[2:]] = {Text.of(one): keywords[one] for one in keywords if one not in named}
    else:
        frame.names[name[1:]] = list(arguments[place:])
