"""What outlives the call that uses it: variables that functions of C++ keep, and what returned references lead to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Obj, QosValue, Unknown, Value
from roslens.source.extract.domain.kinds import is_number
from roslens.source.extract.ir.assigned_names import assigned_names
from roslens.source.extract.ir.program import Assign, Name, Return
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def once(ctx: Context, statement: Assign) -> Value:
    """Return what a variable holds that lives on between calls: what the first call made, or a later one put there."""
    frame, touched = ctx.state.frame, ctx.summaries.touched
    key = (frame.path, statement.line, frame.scope, str(statement.target), *frame.templates.values())
    match statement.target:
        case Name(name=name):
            pass
        case _:
            name = ""
    frame.kept = {**frame.kept, name: key}
    if key in ctx.state.once:
        return ctx.state.once[key]
    if statement.value is None:
        ctx.state.written_at(statement.line)
        value = ctx.objects.declared(statement.declared)
    else:
        value = ctx.objects.converted(statement.declared, ctx.value(statement.value))
    if is_number(value) and _is_assigned(ctx, name):
        # Which call it is decides it, and calls in loops are followed once for all turns.
        value = Unknown(f"{name}, which is kept between calls")
    match value:
        case Obj() | QosValue() | Text() | bool() | Unknown() if ctx.summaries.touched == touched:
            ctx.state.once[key] = value
    return value


def keep(ctx: Context, name: str, value: Value) -> None:
    """Put a value into a variable of the function that lives on between calls."""
    ctx.state.frame.names[name] = value
    ctx.summaries.forget_all()
    ctx.state.store.put(ctx.state.once, ctx.state.frame.kept[name], value)


def returned(ctx: Context, statement: Return) -> None:
    """Note where the value stands that a function returns a reference or pointer to."""
    hands = bool(ctx.stack.calls) and ctx.stack.calls[-1][1].hands
    ctx.state.gave = (ctx.state.frame, statement.value) if hands and statement.value is not None else None


def no_place(ctx: Context) -> None:
    """Forget the storage of a value: the next call sets it, if any does."""
    ctx.state.gave = None


def put_where_it_stands(ctx: Context, before: Value, after: Value) -> None:
    """Put what a returned reference was changed to where it leads; ``before`` is what the call returned."""
    if ctx.state.gave is None:
        return
    outer = ctx.state.frame
    ctx.state.frame, place = ctx.state.gave
    try:
        if ctx.value(place) is before:
            ctx.assign(place, after)
    finally:
        ctx.state.frame = outer


def _is_assigned(ctx: Context, name: str) -> bool:
    return bool(ctx.stack.calls) and name in assigned_names(ctx.stack.calls[-1][1].body)
