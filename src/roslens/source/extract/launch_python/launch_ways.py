"""What ways of an open condition come to in launch files: of two values neither is taken for the other."""

from __future__ import annotations

import msgspec

from roslens.source.extract.domain.abstract_value import Obj, Unknown, Value
from roslens.source.extract.domain.frame import Frame, Held
from roslens.source.extract.domain.frame import join as join_names
from roslens.source.extract.domain.guarded import Guarded, guarded
from roslens.source.extract.domain.store import Store
from roslens.source.extract.launch_python.launch_values import Either, Made
from roslens.source.extract.symbolic.condition import all_of, negated
from roslens.source.extract.symbolic.text import Condition, Text
from roslens.source.extract.transfer.context import Context

_SIMPLE = (Text, Unknown, bool, int, float, type(None))


class LaunchStore(Store):
    """What ways change in lists and tables of a launch file."""

    def joined(self, one: list[Value], other: list[Value], condition: Condition, test: Condition | None) -> Value:
        """Return what is known of two lists of which a condition chooses; None where either may stand."""
        found = joined(one, other, condition)
        return super().joined(one, other, condition, test) if found is None else found


class LaunchFrame(Frame):
    """One call of a function of a launch file."""

    def as_returned(self, value: Value, *, open_: bool) -> Value:
        """Return a value as it is now: where a function may go on, what it returned is not changed by what follows."""
        match value:
            case list() if open_:
                return list(value)
            case Made() if open_:
                return msgspec.structs.replace(value, positional=list(value.positional))
        return value

    def join(self, other: Held, condition: Condition) -> None:
        """Let names hold what either way of a condition came to, ``other`` being that where it is true."""
        for name, value in other[0].items():
            self.names[name] = either(value, self.names.get(name, value), condition)
        if isinstance(self.self, Obj):
            join_names(self.self.fields, other[1], condition)

    def _or_else(self, value: Value, given: Condition) -> Value:
        return either(self.result, value, given)


def either(one: Value, other: Value, condition: Condition) -> Value:
    """Return the value that is one where a condition holds, and the other one where it does not."""
    if one is other or (type(one) is type(other) and isinstance(one, _SIMPLE) and one == other):
        return one
    if isinstance(one, list) and isinstance(other, list):
        both = joined(one, other, condition)
        if both is not None:
            return both
    return Either(condition, one, other)


def joined(one: list[Value], other: list[Value], condition: Condition) -> list[Value] | None:
    """Return a list of which some items are there under a condition, or its opposite; None where it has others."""
    same = 0
    while same < min(len(one), len(other)) and one[same] is other[same]:
        same += 1
    if not all(isinstance(item, Made | Guarded) for item in (*one[same:], *other[same:])):
        return None
    then, otherwise = guarded(one[same:], condition, None), guarded(other[same:], negated(condition), None)
    return [*one[:same], *then, *otherwise]


def kept(ctx: Context, value: Value) -> Value:
    """Return a value that a list gets: it has it if what is around now holds, wherever it was made."""
    if not isinstance(value, Made):
        return value
    around = tuple(one for one in dict.fromkeys(ctx.state.conditions) if one not in value.conditions)
    return Guarded(value, all_of(around)) if around else value
