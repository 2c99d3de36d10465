"""Messages of ROS 2 from mappings of their fields, and back."""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib import import_module
from typing import Any

from roslens.live.act.ros import ActionError

_TYPE = re.compile(r"([a-z][a-z0-9_]*)/(?:(msg|srv)/)?([A-Z][A-Za-z0-9]*)\Z")
_SEQUENCE = re.compile(r"(?:sequence<(?P<of>.+?)(?:, \d+)?>|(?P<fixed>.+)\[(?P<size>\d+)\])\Z")
_REAL = ("float", "double")
_HEADER = "std_msgs/msg/Header"
_DEEPEST = 20


def interface(type_: str, room: str) -> Any:
    """Return the class of a message (``room`` is ``msg``) or service (``srv``).

    Raises:
        ActionError: there is none of that name here.
    """
    found = _TYPE.match(type_)
    if found is None or found[2] not in (None, room):
        raise ActionError(f"the type {type_[:80]!r}", expected=f"`package/{room}/Type`")
    try:
        return getattr(import_module(f"{found[1]}.{room}"), found[3])
    except (ImportError, AttributeError) as error:
        advice = "Source the workspace that has it before roslens is started"
        raise ActionError(
            f"there is no {type_} here: {error}", expected="a type that was built", advice=advice
        ) from None


def filled(kind: Any, fields: Mapping[str, Any], stamp: tuple[int, int]) -> Any:
    """Return a message of a class with these values; headers without a stamp are stamped.

    Args:
        kind: class of the message.
        fields: by name; others keep their default.
        stamp: seconds and nanoseconds since the epoch.

    Raises:
        ActionError: there is no such field, or its value does not fit.
    """
    return _filled(kind, fields, stamp, kind.__name__, 0)


def plain(message: Any, depth: int = 0) -> Any:
    """Return a message as mappings, lists and plain values."""
    if hasattr(message, "get_fields_and_field_types") and depth < _DEEPEST:
        return {name: plain(getattr(message, name), depth + 1) for name in message.get_fields_and_field_types()}
    if isinstance(message, (str, bool, int, float)) or message is None:
        return message
    if isinstance(message, (bytes, bytearray)):
        return message[0] if len(message) == 1 else message.hex()
    if hasattr(message, "tolist"):
        return message.tolist()
    return [plain(one, depth + 1) for one in message]


def _filled(kind: Any, fields: Any, stamp: tuple[int, int], place: str, depth: int) -> Any:
    if not isinstance(fields, Mapping) or depth > _DEEPEST:
        raise ActionError(f"{place} is {str(fields)[:60]!r}", expected="fields with their values")
    message = kind()
    types = message.get_fields_and_field_types()
    for name, value in fields.items():
        if name not in types:
            raise ActionError(f"{place} has no field {str(name)[:60]!r}", expected=", ".join(types)[:200])
        where = f"{place}.{name}"
        try:
            setattr(message, name, _value(types[name], value, stamp, where, depth + 1))
        except (AssertionError, TypeError, ValueError, OverflowError) as error:
            raise ActionError(f"{where} is {str(value)[:60]!r}", expected=f"{types[name]} ({error})"[:200]) from None
    _stamp(message, types, fields, stamp)
    return message


def _value(type_: str, value: Any, stamp: tuple[int, int], place: str, depth: int) -> Any:
    if found := _SEQUENCE.match(type_):
        return _values(found["of"] or found["fixed"], value, stamp, place, depth)
    if "/" in type_:
        package, _, name = type_.partition("/")
        return _filled(interface(f"{package}/{name}", "msg"), value, stamp, place, depth)
    if type_ in _REAL and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if type_ == "octet" and isinstance(value, int):
        return bytes([value])
    if type_ == "boolean" and not isinstance(value, bool):
        raise ActionError(f"{place} is {str(value)[:60]!r}", expected="true or false")
    return value


def _values(of: str, value: Any, stamp: tuple[int, int], place: str, depth: int) -> Any:
    if of in ("octet", "uint8") and isinstance(value, (bytes, bytearray)):
        return [bytes([one]) for one in value] if of == "octet" else value
    if not isinstance(value, (list, tuple)):
        raise ActionError(f"{place} is {str(value)[:60]!r}", expected="a list")
    return [_value(of, one, stamp, f"{place}[{index}]", depth) for index, one in enumerate(value)]


def _stamp(message: Any, types: Mapping[str, str], fields: Mapping[str, Any], stamp: tuple[int, int]) -> None:
    """Stamp the header of a message, unless its fields do."""
    if types.get("header") not in ("std_msgs/Header", _HEADER):
        return
    header = fields.get("header")
    if not (isinstance(header, Mapping) and "stamp" in header):
        message.header.stamp.sec, message.header.stamp.nanosec = stamp
