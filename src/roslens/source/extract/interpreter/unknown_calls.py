"""Calls of methods of plain values, and of what is not known: what they are given may be set or called by them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Names, Unknown, Value
from roslens.source.extract.domain.plain_methods import plain_method
from roslens.source.extract.ir.program import Call, Member, Name
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.transfer.changed_values import CHANGING, changed_by

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_PLACES = frozenset({Name, Member})
_ADDING = frozenset({"append", "push_back", "emplace_back", "add"})


def method_of_plain(
    ctx: Context, expression: Call, function: Member, of: Value, arguments: list[Value], keywords: Names
) -> Value:
    """Return the result of a method of a text, a list or a table, or of what is not known."""
    name = function.name
    change = changed_by(ctx, function.of, of, name, arguments, keywords) if name in CHANGING else None
    if change is not None:
        return change[0]
    match of:
        case list() if name in _ADDING and ctx.state.store.open:
            ctx.state.store.items(of)
    found = plain_method(of, name, arguments)
    if arguments:
        _given_away(ctx, expression, name, of, arguments, found)
    return found


def _given_away(ctx: Context, expression: Call, name: str, of: Value, arguments: list[Value], found: Value) -> None:
    match of:
        case list() | dict():
            return
        case Text():
            pass
        case _:
            may_set(ctx, expression, arguments, name)
    match found:
        case Unknown():
            for one in arguments:
                ctx.callbacks.give(one)


def may_set(ctx: Context, expression: Call, arguments: list[Value], name: str) -> None:
    """Let texts be unknown that are empty when they are given to what is not known: they may be what it sets."""
    for written, value in zip(expression.arguments, arguments, strict=False):
        match value:
            case Text(parts=()) if type(written) in _PLACES and ctx.dialect.calls_set_arguments:
                ctx.assign(written, unknown(f"a string that {name}() may set"))
