"""The vocabulary of parameters of ROS 2: declared, read and written by rclcpp, rclpy and what Nav2 has around them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.domain.abstract_value import Obj, Unknown, Value, as_text
from roslens.source.extract.domain.kinds import text_of
from roslens.source.extract.domain.parameter_types import VECTOR, type_of_constant, type_of_cpp, type_of_value
from roslens.source.extract.domain.typed_list import TypedList
from roslens.source.extract.interpreter.vocabulary import CallSite, method, outer
from roslens.source.extract.overlays.ros.emit import is_set, parameter
from roslens.source.extract.overlays.ros.vocabulary_descriptors import described_by, is_descriptor
from roslens.source.extract.symbolic.text import Text, unknown

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_PYTHON = ("rclpy.parameter.Parameter", "rclpy.Parameter")


@method("node", "declare_parameter", anywhere=True)
def declare(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A parameter is declared."""
    default = called.argument(1, "value", "default_value")
    return _declared(ctx, thing, called, called.argument(0, "name"), default, _template(called))


@method("node", "declare_or_get_parameter", anywhere=True)
def declare_or_read(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A parameter is declared, or read where it is declared already, as nodes of Nav2 do."""
    return declare(ctx, thing, called)


@outer(
    *(f"{space}.{name}" for space in ("nav2_util", "nav2", "nav2_ros_common")
      for name in ("declare_parameter_if_not_declared", "declare_or_get_parameter")),
)  # fmt: skip
def declare_of(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A parameter of the node that is given first is declared, if it is not yet."""
    named = next((place for place, one in enumerate(called.arguments) if text_of(one) is not None), 1)
    inner = msgspec.structs.replace(called, arguments=called.arguments[named:], written=called.written[named:])
    return declare(ctx, called.argument(0), inner)


def _declared(ctx: Context, thing: Value, called: CallSite, name: Value, default: Value, kind: str) -> Value:
    if is_descriptor(default):
        default = None
    constant = type_of_constant(default)
    if constant is not None:
        kind, default = kind or constant, None
    match default:
        case Obj(type=held) if held.endswith("ParameterValue"):
            default = default.fields.get("value")
    python = called.evidence.path.endswith(".py")
    held_to = kind or (type_of_value(default, python=python) if text_of(default) is None else "")
    described = described_by((*called.arguments[1:], *called.keywords.values()), held_to)
    if constant is None and default is None and not kind and python:
        # rclpy takes what has neither value nor type for one of any type.
        described = msgspec.structs.replace(described, terms=msgspec.structs.replace(described.terms, dynamic=True))
    return parameter(
        ctx, thing, called, "declared", name, default=_fitting(default, kind), given=default is not None,
        kind=kind, described=described,
    )  # fmt: skip


def _fitting(default: Value, kind: str) -> Value:
    """Return a default in the type that a template argument makes of it."""
    if kind == "double" and type(default) is int:
        return float(default)
    match default:
        case list() if kind == "double_array":
            return TypedList((float(one) if type(one) is int else one for one in default), kind)
    return default


@outer("rclcpp.ParameterValue", "rclcpp.Parameter", *_PYTHON)
def parameter_value(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A value of a parameter."""
    if called.name == "rclcpp.ParameterValue":
        value = called.argument(0, default=Unknown("a value that is not set"))
    else:
        place = 2 if called.name in _PYTHON else 1
        value = called.argument(place, "value", default=Unknown("a parameter"))
    match value:
        case TypedList():
            return value
        case list():
            # Braces around it construct nothing: it is a value.
            return TypedList(value, type_of_value(value, python=called.name in _PYTHON))
    return value


def _template(called: CallSite) -> str:
    return type_of_cpp(called.templates[0]) if called.templates else ""


@method("node", "declare_parameters", anywhere=True)
def declare_all(ctx: Context, thing: Value, called: CallSite) -> Value:
    """Several parameters are declared at once."""
    prefix, given, kind = called.argument(0, "namespace"), called.argument(1, "parameters"), _template(called)
    items: list[Value] = [[unknown("a parameter of a list that is not evaluated")]]
    match given:
        case dict():
            items = list(given.items())
        case list():
            items = given
    for one in items:
        match one:
            case [first, *rest]:
                name = as_text(first)
            case _:
                name, rest = unknown("a parameter that is not evaluated"), []
        if as_text(prefix).parts:
            name = Text.of(as_text(prefix), ".", name)
        default = rest[0] if rest else None
        inner = msgspec.structs.replace(called, arguments=[name, default, *rest[1:]], keywords={}, written=())
        _declared(ctx, thing, inner, name, default, kind)
    return None


@method("node", "get_parameter", "get_parameter_or", anywhere=True)
def read(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A parameter is read, into a variable where one is given."""
    python = called.evidence.path.endswith(".py")
    default = called.argument(1 if python else 2, "alternative_value")
    into = None if python else called.argument(1)
    kind = _template(called)
    match into:
        case Text(holes=()):
            # A text with holes is what a variable of another type was read into before.
            kind = kind or type_of_value(into)
        case Obj(type=held) if held == VECTOR:
            kind = kind or type_of_value(into)
    value = parameter(
        ctx, thing, called, "read", called.argument(0, "name"), default=default, given=default is not None, kind=kind
    )
    if not python and len(called.written) > 1:
        ctx.assign(called.written[1], value)
        return Unknown("whether the parameter is set", is_set(value))
    return value


@method("node", "set_parameter", "set_parameters", "has_parameter", anywhere=True)
def write(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A parameter is written, or asked for; by names that are not followed."""
    return Unknown(f"result of {called.name}()")
