"""Operators of a Python launch file on values that may be substitutions or unknown."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Sequence
from typing import Any

from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.launch_python.launch_action import text
from roslens.source.extract.launch_python.python_value import Unknown, as_value
from roslens.source.extract.symbolic.text import Text

_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Sub: lambda one, other: one - other,
    ast.Mult: lambda one, other: one * other,
    ast.FloorDiv: lambda one, other: one // other,
    ast.Mod: lambda one, other: one % other,
    ast.Div: lambda one, other: one / other,
}
_COMPARE: dict[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Eq: lambda one, other: one == other,
    ast.NotEq: lambda one, other: one != other,
    ast.Lt: lambda one, other: one < other,
    ast.LtE: lambda one, other: one <= other,
    ast.Gt: lambda one, other: one > other,
    ast.GtE: lambda one, other: one >= other,
    ast.In: lambda one, other: one in other,
    ast.NotIn: lambda one, other: one not in other,
    ast.Is: lambda one, other: one is other,
    ast.IsNot: lambda one, other: one is not other,
}
_LONGEST = 10_000
_PLACE = re.compile("%[sdr]")


def combined(operator: ast.operator, one: Any, other: Any) -> Any:
    """Return two values put together by a binary operator; ``/`` with a text joins a path."""
    if isinstance(one, Unknown):
        return one
    if isinstance(operator, ast.Mod) and isinstance(one, str):
        return _formatted(one, other if isinstance(other, list) else [other])
    if isinstance(other, Unknown) and not isinstance(operator, ast.Add):
        return other
    symbolic = isinstance(one, Deferred | Text) or isinstance(other, Deferred | Text | Unknown)
    match operator:
        case ast.Add():
            return _added(one, other, symbolic=symbolic)
        case ast.Div() if symbolic or isinstance(one, str):
            return Deferred("path", (as_value(one), as_value(other)))
    if symbolic or isinstance(one, list | dict) or isinstance(other, list | dict):
        return Unknown("a computation with values that are not known")
    function = _BINARY.get(type(operator))
    if function is None or _size(one) * _size(other) > _LONGEST:
        return Unknown("a computation that is not followed")
    try:
        return function(one, other)
    except (TypeError, ValueError, ArithmeticError, KeyError) as error:
        return Unknown(f"a computation that fails: {error}")


def compared(operators: Sequence[ast.cmpop], values: Sequence[Any]) -> bool | None:
    """Return whether a chain of comparisons of plain values holds; None where they cannot be compared."""
    try:
        pairs = zip(operators, values, values[1:], strict=False)
        return all(_COMPARE[type(operator)](one, other) for operator, one, other in pairs)
    except TypeError:
        return None


def put(whole: Any, key: Any, value: Any) -> None:
    """Put an item into a list or dictionary, where that is possible."""
    match whole:
        case dict():
            if isinstance(key, str | int):
                whole[key] = value
        case list() if isinstance(key, int) and -len(whole) <= key < len(whole):
            whole[key] = value


def _formatted(pattern: str, values: list[Any]) -> Any:
    pieces = _PLACE.split(pattern)
    if len(pieces) != len(values) + 1 or "%" in "".join(pieces):
        return Unknown(f"the format {pattern!r}")
    parts = [piece for pair in zip(pieces, map(as_value, values), strict=False) for piece in pair]
    return text(*parts, pieces[-1])


def _added(one: Any, other: Any, *, symbolic: bool) -> Any:
    match one:
        case str() | list() if isinstance(other, str | list) and len(one) + len(other) > _LONGEST:
            return Unknown("a text or list that is too long to follow")
        case list() if isinstance(other, list):
            return [*one, *other]
    if symbolic and not isinstance(one, list):
        return text(as_value(one), as_value(other))
    plain = isinstance(one, str) == isinstance(other, str) and isinstance(one, str | int | float)
    return one + other if plain and isinstance(other, str | int | float) else Unknown("a sum of different kinds")


def _size(value: Any) -> int:
    return len(value) if isinstance(value, str) else min(abs(int(value)), _LONGEST + 1) if isinstance(value, int) else 1
