"""Descriptors of parameters: range, description, whether they are read only or of any type."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeGuard

from roslens.source.extract.domain.abstract_value import Names, Obj, Value
from roslens.source.extract.domain.kinds import all_of_kind, is_number, items_of, known_text
from roslens.source.extract.facts.node_facts import Terms
from roslens.source.extract.interpreter.vocabulary import CallSite, method, outer
from roslens.source.extract.overlays.ros.emit import Described

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_DESCRIPTOR = "rcl_interfaces.msg.ParameterDescriptor"
_RANGES = {"integer_range": "rcl_interfaces.msg.IntegerRange",
           "floating_point_range": "rcl_interfaces.msg.FloatingPointRange"}  # fmt: skip
_CHECKED = {"int": ("integer_range",), "double": ("floating_point_range",)}
"""Which range rclcpp and rclpy hold a value of a type to; the other one is never looked at."""
_SET = "set__"


@outer(_DESCRIPTOR, quiet=True)
def descriptor(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A descriptor: with an empty range of each kind, which C++ makes by ``resize(1)``."""
    if called.arguments and is_descriptor(called.arguments[0]):
        return called.arguments[0]
    ranges: Names = {name: [Obj(kind, None, {})] for name, kind in _RANGES.items()}
    return Obj(_DESCRIPTOR, None, {**ranges, **called.keywords})


@outer(*_RANGES.values(), quiet=True)
def bounds(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The range of a number."""
    whole = called.given(Obj, 0)
    if whole is not None:
        return whole
    places = dict(zip(("from_value", "to_value", "step"), called.arguments, strict=False))
    return Obj(called.name, None, {**places, **called.keywords})


@method("ParameterDescriptor", *(f"{_SET}{name}" for name in ("name", "type", "description", "additional_constraints",
        "read_only", "dynamic_typing", *_RANGES)))  # fmt: skip
@method("IntegerRange", *(f"{_SET}{name}" for name in ("from_value", "to_value", "step")))
@method("FloatingPointRange", *(f"{_SET}{name}" for name in ("from_value", "to_value", "step")))
def set_field(_ctx: Context, thing: Value, called: CallSite) -> Value:
    """A field is set: ``descriptor.set__read_only(true)``."""
    match thing:
        case Obj():
            thing.fields[called.name.removeprefix(_SET)] = called.argument(0)
    return thing


def is_descriptor(value: Value) -> TypeGuard[Obj]:
    """Whether a value describes a parameter."""
    match value:
        case Obj(type=kind):
            return kind.rpartition(".")[2] == "ParameterDescriptor"
    return False


def described_by(values: Iterable[Value], kind: str = "") -> Described:
    """Return the properties of a parameter of a type from the descriptor among some values; empty ones are unknown."""
    found = next((one.fields for one in values if is_descriptor(one)), None)
    if found is None:
        return Described()
    text, more = found.get("description"), found.get("additional_constraints")
    ranges = [one for name in _CHECKED.get(kind, _RANGES) if (one := _range(found.get(name)))]
    return Described(
        ranges[0] if ranges else "",
        (known_text(text) or ""),
        Terms(
            read_only=found.get("read_only") is True,
            dynamic=found.get("dynamic_typing") is True,
            constraints=(constraint,) if (constraint := known_text(more)) else (),
        ),
    )


def _range(given: Value) -> str:
    """Return a range of numbers as text; empty where there is none, or one of its ends is unknown."""
    items = items_of(given) or [given]
    fields = next((one.fields for one in reversed(all_of_kind(items, Obj)) if one.fields), None)
    ends = [] if fields is None else [fields.get(name, 0) for name in ("from_value", "to_value")]
    known = [one for one in ends if is_number(one)]
    return f"{known[0]}..{known[1]}" if len(known) == 2 else ""
