"""Types of parameters from conversions of their values: ``get_parameter("x").as_double()`` implies a double."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.domain.abstract_value import Value
from roslens.source.extract.domain.parameter_types import type_of_cpp
from roslens.source.extract.domain.plain_methods import plain_method
from roslens.source.extract.interpreter.vocabulary import CallSite, method
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_AS = {
    "as_bool": "bool", "as_int": "int", "as_double": "double", "as_string": "string", "as_byte_array": "byte_array",
    "as_bool_array": "bool_array", "as_integer_array": "int_array", "as_double_array": "double_array",
    "as_string_array": "string_array",
}  # fmt: skip


@method("text", *_AS, "get_value", "get", quiet=True)
def taken(ctx: Context, thing: Text, called: CallSite) -> Value:
    """The value of a parameter is taken for one of a type."""
    kind = _AS.get(called.name) or (type_of_cpp(called.templates[0]) if called.templates else "")
    if kind:
        _note(ctx, thing, kind)
    return plain_method(thing, called.name, called.arguments)


def _note(ctx: Context, value: Text, kind: str) -> None:
    """Give a parameter that was read, and of which no type is known, the type that it is taken for."""
    hole = value.only
    if hole is None or not hole.parameter:
        return
    known = ctx.emitter.node.parameters
    for place in range(len(known) - 1, -1, -1):
        one = known[place]
        if one.access == "read" and hole.parameter in (one.name.known, one.name.pattern):
            if not one.type:
                known[place] = msgspec.structs.replace(one, type=kind)
            return
