"""Objects that are one or another by conditions: what stands for both, and the conditions of each."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Obj
from roslens.source.extract.symbolic.condition import negated
from roslens.source.extract.symbolic.text import Condition, Conditions, NoException

_MOST = 12
"""Objects that are kept apart; of more the last one stands for all."""


def one_object(value: Obj, other: Obj, condition: Condition) -> Obj | None:
    """Return an object that is one where a condition holds, and another one else; None where either may stand.

    It shows what the other one is, and does what both do.
    """
    mine, its = value.defined, other.defined
    nodes = value.node is not None or other.node is not None
    if mine is None or its is None or nodes or type(condition) is NoException:
        return None
    if mine.what is its.what and not value.ways and not other.ways:
        return None
    ways = (*_under(condition, value), *_under(negated(condition), other))
    if len(ways) > _MOST:
        return None
    return Obj(other.type, its, other.fields, None, other.templates, other.base_templates, ways)


def _under(condition: Condition, one: Obj) -> tuple[tuple[Conditions, Obj], ...]:
    ways = one.ways or (((), one),)
    return tuple(((condition, *conditions), thing) for conditions, thing in ways)
