"""The type of a parameter: of a value, of a type of C++, of a constant that names one.

Types are those of ROS 2 as people write them: ``bool``, ``int``, ``double``, ``string`` and arrays of them
(rcl_interfaces, ``ParameterType``).
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from roslens.source.extract.domain.abstract_value import Obj, Value
from roslens.source.extract.domain.kinds import name_of
from roslens.source.extract.domain.typed_list import TypedList
from roslens.source.extract.ir.type_names import type_arguments, type_name
from roslens.source.extract.parameters.ros2_values import LIST
from roslens.source.extract.symbolic.text import Text

_WHOLE = re.compile(
    r"(?:un)?signed(?: (?:char|short|int|long))*|(?:short|long)(?: (?:int|long))*|u?int(?:\d+_t)?|s?size_t"
)
_WORDS = {
    "bool": "bool", "double": "double", "float": "double", "string": "string", "string_view": "string",
    "char": "string", "byte": "byte",
}  # fmt: skip
_BYTES = frozenset({"uint8_t", "unsigned char", "byte"})
_CONSTANTS = {
    "BOOL": "bool", "INTEGER": "int", "DOUBLE": "double", "STRING": "string", "BYTE_ARRAY": "byte_array",
    "BOOL_ARRAY": "bool_array", "INTEGER_ARRAY": "int_array", "DOUBLE_ARRAY": "double_array",
    "STRING_ARRAY": "string_array",
}  # fmt: skip
_CONSTANT = re.compile(
    r"(?:rclcpp|rcl_interfaces\.msg)\.(?:ParameterType\.)?PARAMETER_(\w+)|(?:rclpy\.(?:parameter\.)?)?Parameter\.Type\.(\w+)"
)


def type_of_cpp(written: str) -> str:
    """Return the type of a parameter that is declared as a type of C++; empty where it is none."""
    plain = " ".join(written.replace("const ", "").rstrip("&* ").split())
    name, inside = type_name(plain)
    if name in ("std.vector", "vector"):
        return array_of_cpp((type_arguments(inside) or [""])[0])
    return _one(plain)


def array_of_cpp(item: str) -> str:
    """Return the type of a parameter that is a ``std::vector`` of a type; empty where it is none."""
    item = item.strip()
    if item.removeprefix("std::") in _BYTES:
        return "byte_array"
    found = _one(item)
    return f"{found}_array" if found else ""


def _one(written: str) -> str:
    name = written.removeprefix("std::")
    return _WORDS.get(name) or ("int" if _WHOLE.fullmatch(name) else "")


def type_of_constant(value: Value) -> str | None:
    """Return the type that a constant names, empty of ``PARAMETER_NOT_SET``; None where it names none."""
    found = _CONSTANT.fullmatch(name_of(value))
    return None if found is None else _CONSTANTS.get(found[1] or found[2], "")


def type_of_value(value: Value, *, python: bool = False) -> str:
    """Return the type of a parameter by a value of it; empty where it is unknown.

    Args:
        value: as it is evaluated.
        python: whether it is one of Python, where the items of a list tell its type; a list of C++ has one type.
    """
    match value:
        case bool():
            return "bool"
        case int():
            return "int"
        case float():
            return "double"
        case Text():
            return "string"
        case TypedList() if value.type:
            return value.type
        case list():
            return type_of_items((type_of_value(one) for one in value), python=python, empty=not value)
        case Obj() if value.type == VECTOR:
            return array_of_cpp(value.templates.get(ITEM, ""))
    return ""


VECTOR, ITEM = "std.vector", "T"


def type_of_items(types: Iterable[str], *, python: bool, empty: bool) -> str:
    """Return the type of a list by the types of its items."""
    if empty and python:
        # The first question of rclpy is whether all items are bytes (Parameter.Type.from_parameter_value).
        return "byte_array"
    known = {one for one in types if one}
    if known == {"int", "double"} and not python:
        return "double_array"
    return f"{known.pop()}_array" if len(known) == 1 and not next(iter(known)).endswith(("_array", LIST)) else LIST
