"""Objects that are one or another by conditions: each does what its own class says, under its condition."""

from __future__ import annotations

from collections.abc import Callable as Function1
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from roslens.source.extract.abstract_value import Obj
from roslens.source.extract.condition import negated

if TYPE_CHECKING:
    from roslens.source.extract.evaluation import Evaluation

_MOST = 12
"""Objects that are kept apart; of more the last one stands for all."""


def one_object(value: Obj, other: Obj, condition: str) -> Obj | None:
    """Return an object that is one where a condition holds, and another one else; None where either may stand.

    It shows what the other one is, and does what both do.
    """
    mine, its = value.defined, other.defined
    if mine is None or its is None or value.node is not None or other.node is not None or condition == "no exception":
        return None
    if mine.what is its.what and not value.ways and not other.ways:
        return None
    ways = (*_under(condition, value), *_under(negated(condition), other))
    if len(ways) > _MOST:
        return None
    return Obj(other.type, its, other.fields, None, other.templates, other.base_templates, ways)


def _under(condition: str, one: Obj) -> tuple[tuple[tuple[str, ...], Obj], ...]:
    ways = one.ways or (((), one),)
    return tuple(((condition, *conditions), thing) for conditions, thing in ways)


def each_way(engine: Evaluation, several: Obj, called: Function1[[Obj], Any]) -> Any:
    """Call a method of each object that it may be, and return what the last one returns."""
    found = None
    for conditions, thing in several.ways:
        with _conditions(engine, conditions):
            found = called(thing)
    return found


@contextmanager
def _conditions(engine: Evaluation, conditions: tuple[str, ...]) -> Iterator[None]:
    for one in conditions:
        engine.under(one)
    try:
        yield
    finally:
        for _ in conditions:
            engine.conditions.pop()
