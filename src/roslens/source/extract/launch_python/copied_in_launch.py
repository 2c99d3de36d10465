"""Copies in launch files: either of two values that a condition chooses, and what objects of launch hold."""

from __future__ import annotations

from collections.abc import Callable as Function1

import msgspec

from roslens.source.extract.domain.abstract_value import Value
from roslens.source.extract.interpreter.copied_values import Inside, copied, deep_copied
from roslens.source.extract.launch_python.launch_values import Either, Made
from roslens.source.extract.transfer.context import Context

COPIES = frozenset({"copy.copy", "copy.deepcopy"})


def copied_in_launch(ctx: Context, value: Value, *, deep: bool) -> Value:
    """Return a copy of a value, with ``deep`` of all that it holds."""
    if deep:
        return deep_copied(ctx, value, _others(ctx))

    def again(one: Value) -> Value:
        return copied_in_launch(ctx, one, deep=False)

    match value:
        case Either():
            return msgspec.structs.replace(value, one=again(value.one), other=again(value.other))
        case Made():
            return msgspec.structs.replace(value, positional=list(value.positional), named=dict(value.named))
    return copied(ctx, value)


def _others(ctx: Context) -> Function1[[Value, Inside], Value]:
    def others(value: Value, inside: Inside) -> Value:
        match value:
            case Either():
                return msgspec.structs.replace(value, one=inside(value.one), other=inside(value.other))
            case Made():
                named = {name: inside(one) for name, one in value.named.items()}
                return msgspec.structs.replace(value, positional=[inside(one) for one in value.positional], named=named)
        return copied(ctx, value, inside)

    return others
