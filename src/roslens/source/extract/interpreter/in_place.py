"""Augmented assignments: in Python they change a list or table in place, for everybody who holds it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Value
from roslens.source.extract.ir.program import Expression, Name
from roslens.source.extract.transfer.changed_values import forget_items

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_NONE = frozenset({"==", "!=", "<=", ">="})


def is_augmented(operator: str) -> bool:
    """Whether an assignment makes the new value of the old one."""
    return len(operator) > 1 and operator.endswith("=") and operator not in _NONE


def augmented(ctx: Context, target: Expression, operator: str, value: Value) -> Value:
    """Return what a place holds after an augmented assignment.

    Args:
        ctx: the evaluation.
        target: the place.
        operator: of the assignment.
        value: with ``+=`` what is added, else what the operation comes to.
    """
    before = ctx.value(target)
    found = ctx.expressions.sum(before, value) if operator == "+=" else value
    if not ctx.dialect.names_share_objects or _is_of_comprehension(target):
        return found
    match before, found:
        case list(), list() if type(before) is list and type(found) is list:
            ctx.state.store.items(before)
            before[:] = found
            return before
        case dict(), dict():
            ctx.state.store.items(before)
            before.update(found)
            return before
        case (list() | dict()) as several, _:
            ctx.state.store.items(several, less=True)
            forget_items(several, "an item of what an augmented assignment changed")
    return found


def _is_of_comprehension(target: Expression) -> bool:
    """Whether a place is what a comprehension fills, which nobody else holds before it is full."""
    match target:
        case Name(name=name):
            return name.startswith("#")
    return False
