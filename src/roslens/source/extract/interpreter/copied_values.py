"""What ``copy.copy`` and ``copy.deepcopy`` give: a shallow copy shares what the original holds, a deep one nothing."""

from __future__ import annotations

from collections.abc import Callable as Function1
from typing import TYPE_CHECKING, TypeAlias

import msgspec

from roslens.source.extract.domain.abstract_value import Obj, Unknown, Value
from roslens.source.extract.domain.guarded import Guarded
from roslens.source.extract.domain.quality import quality_of
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

Inside: TypeAlias = Function1[[Value], Value]


def copied(ctx: Context, value: Value, inside: Inside | None = None) -> Value:
    """Return a copy of a value; ``inside`` copies what it holds, which it shares with the original without."""
    match value:
        case list() if type(value) is not list:
            return value
        case list():
            return list(value) if inside is None else [inside(one) for one in value]
        case dict():
            return dict(value) if inside is None else {key: inside(one) for key, one in value.items()}
        case Guarded():
            return value if inside is None else msgspec.structs.replace(value, value=inside(value.value))
        case Obj():
            return _object_copied(ctx, value, inside)
        case int() | Text() | Unknown():
            return value
    quality = quality_of(value)
    return value if quality is None or not quality.qos else msgspec.structs.replace(quality)


def deep_copied(ctx: Context, value: Value, others: Function1[[Value, Inside], Value] | None = None) -> Value:
    """Return a copy of a value that shares nothing with it; what is held twice is copied once, as Python does.

    Args:
        ctx: the evaluation.
        value: that is copied.
        others: copies a value of a kind that only the caller knows, by a function that copies what it holds.

    Raises:
        BudgetExceededError: it holds too much.
    """
    known: dict[int, tuple[Value, Value]] = {}

    def inside(one: Value) -> Value:
        ctx.budget.spend()
        before = known.get(id(one))
        if before is not None:
            return before[1]
        match one:
            case list() if type(one) is list:
                made: list[Value] = []
                known[id(one)] = (one, made)
                made += [inside(item) for item in one]
                return made
            case dict():
                table = copied(ctx, one)
                known[id(one)] = (one, table)
                match table:
                    case dict():
                        table.update({key: inside(item) for key, item in one.items()})
                return table
        found = copied(ctx, one, inside) if others is None else others(one, inside)
        known[id(one)] = (one, found)
        return found

    return inside(value)


def _object_copied(ctx: Context, value: Obj, inside: Inside | None) -> Value:
    own = "__copy__" if inside is None else "__deepcopy__"
    if value.defined is not None and ctx.index.methods(value.defined, own):
        return Unknown(f"what {own}() returns")
    fields = (
        value.fields if inside is None or value.node is not None else {n: inside(v) for n, v in value.fields.items()}
    )
    return Obj(value.type, value.defined, dict(fields), value.node, value.templates, value.base_templates)
