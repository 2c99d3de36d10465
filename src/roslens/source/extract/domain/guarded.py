"""Items that a list has only if something holds: ``[name for name in names if used(name)]``."""

from __future__ import annotations

import msgspec

from roslens.source.extract.domain.abstract_value import Foreign, Value
from roslens.source.extract.symbolic.condition import all_of
from roslens.source.extract.symbolic.text import And, Condition


class Guarded(Foreign, frozen=True):
    """An item that a list has under a condition, and what decides that, where it is known.

    Only a loop over the list asks for it; to anybody else it is a value of which nothing is known.
    """

    value: Value
    condition: Condition
    test: Condition | None = None


def guarded(items: list[Value], condition: Condition, test: Condition | None) -> list[Value]:
    """Return items that are there if a condition holds; those that are there under another one keep it too."""
    found: list[Value] = []
    for one in items:
        match one:
            case Guarded():
                both = None if test is None or one.test is None else And((test, one.test))
                found.append(Guarded(one.value, all_of((condition, one.condition)), both))
            case _:
                found.append(Guarded(one, condition, test))
    return found


def unguarded(item: Value) -> Value:
    """Return an item of a list, whatever it depends on."""
    return item.value if isinstance(item, Guarded) else item


def in_place_of(item: Value, value: Value) -> Value:
    """Return a value that a list has instead of an item: under the same condition, if that has one."""
    return msgspec.structs.replace(item, value=value) if isinstance(item, Guarded) else value


def is_counted(items: list[Value]) -> bool:
    """Whether a list has all of its items in any case, so that each has its place."""
    return not any(type(one) is Guarded for one in items)
