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
        if isinstance(one, Assign) and one.target == place and one.operator == "=":
            return one.value is not None and _holds(one.value, place)
        if isinstance(one, Assign):
            if _holds((one.target, one.value), place):
                return True
        elif isinstance(one, Branch | Loop):
            if _reads(one, place):
                return True
        elif _holds(one, place):
            return True
    return False


def _reads(one: Branch | Loop, place: Expression) -> bool:
    parts = (one.then, one.otherwise) if isinstance(one, Branch) else ((*one.body, *one.update),)
    head = one.condition if isinstance(one, Branch) else (one.target, one.over)
    return _holds(head, place) or any(is_read_first(part, place) for part in parts)


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
