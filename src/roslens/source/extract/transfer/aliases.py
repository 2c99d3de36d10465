"""Other names of plain values of C++: ``std::string & name = options.name;``, ``bool * found = &found_;``.

Objects are the same under each of their names. A text or number is a value to evaluation: what is set under the other
name has to be set where it stands, and is read there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import QosValue, Unknown, Value
from roslens.source.extract.domain.kinds import text_of
from roslens.source.extract.ir.program import Assign, Call, Expression, Member, Name
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.transfer.static_storage import no_place

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def refer(ctx: Context, statement: Assign) -> bool:
    """Let a declared name be another one of what it is declared to be; return whether it is one of a plain value."""
    match statement:
        case Assign(target=Name() as name, value=Call(arguments=(), keywords=()) as call):
            return _refer_to_result(ctx, statement, name, call)
        case Assign(target=Name() as name, value=Name() | Member() as value) if value != name and _stays(value):
            return _refer_to_place(ctx, statement, name, value)
    return False


def _refer_to_place(ctx: Context, statement: Assign, name: Name, value: Expression) -> bool:
    frame = ctx.state.frame
    if not _is_plain(ctx.value(value)):
        frame.aliases = {known: one for known, one in frame.aliases.items() if known != name.name}
        return False
    frame.names.pop(name.name, None)
    frame.aliases = {**frame.aliases, name.name: (value, statement.operator == "*")}
    return True


def _is_plain(value: Value) -> bool:
    match value:
        case Text() | bool() | int() | float() | QosValue():
            return True
    return False


def _refer_to_result(ctx: Context, statement: Assign, name: Name, call: Call) -> bool:
    """Let a name be another one of what a call returns a reference to; return True."""
    frame = ctx.state.frame
    no_place(ctx)
    value = ctx.objects.converted(statement.declared, ctx.value(call)) if statement.declared else ctx.value(call)
    frame.names.pop(name.name, None)
    if ctx.state.gave is not None and _is_plain(value):
        frame.aliases = {**frame.aliases, name.name: (call, statement.operator == "*")}
    else:
        frame.aliases = {known: one for known, one in frame.aliases.items() if known != name.name}
        frame.names[name.name] = value
    return True


def assign_referred(ctx: Context, name: str, value: Value) -> None:
    """Put a value where another name of it leads; a pointer may point elsewhere meanwhile."""
    expression, pointer = ctx.state.frame.aliases[name]
    if pointer:
        reason = f"the object that {name} points to"
        value = Unknown(reason) if text_of(ctx.value(expression)) is None else unknown(reason)
    ctx.assign(expression, value)


def _stays(value: Expression) -> bool:
    """Whether an expression means the same place later on: a name, or a member of what is one."""
    match value:
        case Member(of=of):
            return _stays(of)
        case Name():
            return True
    return False
