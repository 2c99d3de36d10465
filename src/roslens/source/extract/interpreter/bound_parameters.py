"""What the parameters of a function are when it is called: what is given, a default, or what stands for either."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Handle, Names, QosValue, Unknown, Value
from roslens.source.extract.domain.frame import Frame, bind_rest
from roslens.source.extract.domain.outside_options import options_from_outside
from roslens.source.extract.domain.quality import QUALITY_TYPES
from roslens.source.extract.ir.controller_handles import is_of_controller
from roslens.source.extract.ir.program import Expression, Function, Parameter
from roslens.source.extract.symbolic.reason import OfController
from roslens.source.extract.symbolic.text import unknown
from roslens.source.extract.symbols.node_bases import NODE_BASES
from roslens.source.extract.symbols.symbol_table import type_name

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_TEXTS = ("std.string", "string", "std.string_view", "char")


def bind(ctx: Context, what: Function, arguments: list[Value], keywords: Names, frame: Frame) -> None:
    """Put the parameters of a function into the frame of a call that begins."""
    declared, given, names = None, len(arguments), frame.names
    if given < len(what.parameters):
        declared = ctx.index.declaration(what, frame.path)
    for place, parameter in enumerate(what.parameters):
        if parameter.name[:1] == "*":
            given = min(given, place)
            bind_rest(what, place, arguments, keywords, frame)
        elif place < given:
            names[parameter.name] = ctx.objects.typed(parameter.type, arguments[place])
        elif parameter.name in keywords:
            frame.names[parameter.name] = keywords[parameter.name]
        else:
            default = None if "**" in keywords else _default(parameter, declared, place)
            names[parameter.name] = _by_default(ctx, what, place, default, frame)


def _default(parameter: Parameter, declared: Function | None, place: int) -> Expression | None:
    """Return the default of a parameter, which a declaration elsewhere may say."""
    if parameter.default is not None or declared is None or place >= len(declared.parameters):
        return parameter.default
    return declared.parameters[place].default


def _by_default(ctx: Context, what: Function, place: int, default: Expression | None, frame: Frame) -> Value:
    """Return what a parameter is that is not given."""
    parameter = what.parameters[place]
    if not ctx.stack.keys and parameter.type.rstrip("& ").endswith("NodeOptions"):
        # The loader of a component gives it options, whatever the defaults are.
        return options_from_outside()
    outer, ctx.state.frame = ctx.state.frame, frame
    value = _not_given(ctx, what, parameter) if default is None else ctx.value(default)
    ctx.state.frame = outer
    match value:
        case list() | dict():
            # A default of Python is one object: what a call puts into it the next one finds there.
            return ctx.state.once.setdefault((frame.path, what.line, place, id(what)), value)
    return value


def _not_given(ctx: Context, what: Function, parameter: Parameter) -> Value:
    """Return what stands for an argument that nobody gives; what must be a node is the one that is built."""
    reason = f"parameter {parameter.name} of {what.name}()"
    name = type_name(parameter.type)[0]
    if name in _TEXTS:
        return unknown(reason)
    if name.endswith("NodeOptions"):
        return options_from_outside()
    if name in QUALITY_TYPES:
        return QosValue(unknown=reason)
    if is_of_controller(what, parameter):
        return Handle(ctx.emitter.node, unknown(OfController()))
    return Handle(ctx.emitter.node) if name and _is_node(ctx, name) else Unknown(reason)


def _is_node(ctx: Context, name: str) -> bool:
    """Whether a class by its name as written is a node."""
    name = ctx.state.frame.templates.get(name, name)
    defined = ctx.index.class_of(name, ctx.state.frame.path, ctx.state.frame.scope)
    if defined is None:
        return ctx.index.meaning(name, ctx.state.frame.path, ctx.state.frame.scope) in NODE_BASES
    return any(base in NODE_BASES for base in ctx.index.outer_bases(defined))
