"""Other names of plain values of C++: ``std::string & name = options.name;``, ``bool * found = &found_;``.

Objects are the same under each of their names. A text or number is a value to evaluation: what is set under the other
name has to be set where it stands, and is read there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import QosValue, Unknown, Value
from roslens.source.extract.ir.program import Assign, Call, Expression, Member, Name
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.transfer.static_storage import no_place

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_PLAIN = (Text, bool, int, float, QosValue)


def refer(ctx: Context, statement: Assign) -> bool:
    """Let a declared name be another one of what it is declared to be; return whether it is one of a plain value."""
    frame, name, value = ctx.state.frame, statement.target, statement.value
    if not isinstance(name, Name) or value is None or value == name:
        return False
    if isinstance(value, Call) and not value.arguments and not value.keywords:
        return _refer_to_result(ctx, statement, name, value)
    if not _stays(value):
        return False
    if not isinstance(ctx.value(value), _PLAIN):
        frame.aliases = {known: one for known, one in frame.aliases.items() if known != name.name}
        return False
    frame.names.pop(name.name, None)
    frame.aliases = {**frame.aliases, name.name: (value, statement.operator == "*")}
    return True


def _refer_to_result(ctx: Context, statement: Assign, name: Name, call: Call) -> bool:
    """Let a name be another one of what a call returns a reference to; return True."""
    frame = ctx.state.frame
    no_place(ctx)
    value = ctx.objects.converted(statement.declared, ctx.value(call)) if statement.declared else ctx.value(call)
    frame.names.pop(name.name, None)
    if ctx.state.gave is not None and isinstance(value, _PLAIN):
        frame.aliases = {**frame.aliases, name.name: (call, statement.operator == "*")}
    else:
        frame.aliases = {known: one for known, one in frame.aliases.items() if known != name.name}
        frame.names[name.name] = value
    return True


def assign_referred(ctx: Context, name: str, value: Value) -> None:
    """Put a value where another name of it leads; a pointer may point elsewhere meanwhile."""
    expression, pointer = ctx.state.frame.aliases[name]
    if pointer:
        reason = f"what {name} points to"
        value = unknown(reason) if isinstance(ctx.value(expression), Text) else Unknown(reason)
    ctx.assign(expression, value)


def _stays(value: Expression) -> bool:
    """Whether an expression means the same place later on: a name, or a member of what is one."""
    while isinstance(value, Member):
        value = value.of
    return isinstance(value, Name)
