"""Whether statements read a variable before they set it, so that what an earlier turn of a loop set is seen."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
from msgspec.structs import astuple

from roslens.source.extract.ir.program import Assign, Branch, Expression, Loop, Statement


def is_read_first(body: Sequence[Statement], place: Expression) -> bool:
    """Whether a turn may read a variable or member before it sets it.

    What is set under a condition is not set for sure. A call that reads a member is not looked into.
    """
    for one in body:
        match one:
            case Assign(operator="=") if one.target == place:
                return one.value is not None and _holds(one.value, place)
            case Assign():
                read = _holds((one.target, one.value), place)
            case Branch() | Loop():
                read = _reads(one, place)
            case _:
                read = _holds(one, place)
        if read:
            return True
    return False


def _reads(one: Branch | Loop, place: Expression) -> bool:
    return _holds(one.head, place) or any(is_read_first(part, place) for part in one.parts)


def _holds(whole: object, place: Expression) -> bool:
    """Whether an expression or statement has another one in it."""
    waiting: list[object] = [whole]
    while waiting:
        one = waiting.pop()
        if one == place:
            return True
        match one:
            case tuple():
                waiting += one
            case msgspec.Struct():
                waiting += astuple(one)
    return False
