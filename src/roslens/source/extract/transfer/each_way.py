"""Calls of objects of one class or another by condition: each uses the method of its own class, under its condition."""

from __future__ import annotations

from collections.abc import Callable as Function1
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Obj, Value
from roslens.source.extract.symbolic.text import Conditions

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def each_way(ctx: Context, several: Obj, called: Function1[[Obj], Value]) -> Value:
    """Call a method of each object that it may be, and return what the last one returns."""
    found = None
    for conditions, thing in several.ways:
        with _conditions(ctx, conditions):
            found = called(thing)
    return found


@contextmanager
def _conditions(ctx: Context, conditions: Conditions) -> Iterator[None]:
    for one in conditions:
        ctx.state.under(one)
    try:
        yield
    finally:
        for _ in conditions:
            ctx.state.conditions.pop()
