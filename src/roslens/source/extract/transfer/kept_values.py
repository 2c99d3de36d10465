"""What outlives the call that uses it: variables that functions of C++ keep, and what returned references lead to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Obj, QosValue, Unknown, Value
from roslens.source.extract.ir.assigned_names import assigned_names
from roslens.source.extract.ir.program import Assign, Name, Return
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_COUNTED = (int, float)


def once(engine: Context, statement: Assign) -> Value:
    """Return what a variable holds that lives on between calls: what the first call made, or a later one put there."""
    frame, touched = engine.state.frame, engine.summaries.touched
    key = (frame.path, statement.line, frame.scope, str(statement.target), *frame.templates.values())
    name = statement.target.name if isinstance(statement.target, Name) else ""
    frame.kept = {**frame.kept, name: key}
    if key in engine.state.once:
        return engine.state.once[key]
    if statement.value is None:
        engine.state.written_at(statement.line)
        value = engine.objects.declared(statement.declared)
    else:
        value = engine.objects.converted(statement.declared, engine.value(statement.value))
    if isinstance(value, _COUNTED) and not isinstance(value, bool) and _is_assigned(engine, name):
        # Which call it is decides it, and calls in loops are followed once for all turns.
        value = Unknown(f"{name}, which is kept between calls")
    if isinstance(value, Obj | QosValue | Text | bool | Unknown) and engine.summaries.touched == touched:
        engine.state.once[key] = value
    return value


def keep(engine: Context, name: str, value: Value) -> None:
    """Put a value into a variable of the function that lives on between calls."""
    engine.state.frame.names[name] = value
    engine.summaries.forget_all()
    engine.state.changes.put(engine.state.once, engine.state.frame.kept[name], value)


def returned(engine: Context, statement: Return) -> None:
    """Note where the value stands that a function returns a reference or pointer to."""
    hands = bool(engine.stack.calls) and engine.stack.calls[-1][1].hands
    engine.state.gave = (engine.state.frame, statement.value) if hands and statement.value is not None else None


def no_place(engine: Context) -> None:
    """Forget where a value stands: the next call says it, if any does."""
    engine.state.gave = None


def put_where_it_stands(engine: Context, before: Value, after: Value) -> None:
    """Put what a returned reference was changed to where it leads; ``before`` is what the call returned."""
    if engine.state.gave is None:
        return
    outer = engine.state.frame
    engine.state.frame, place = engine.state.gave
    try:
        if engine.value(place) is before:
            engine.assign(place, after)
    finally:
        engine.state.frame = outer


def _is_assigned(engine: Context, name: str) -> bool:
    return bool(engine.stack.calls) and name in assigned_names(engine.stack.calls[-1][1].body)
