"""A Python expression of a launch file, evaluated without executing it: constants, names that are given, and operators.

Used for ``$(eval …)`` of ROS 1, and for ``PythonExpression`` and ``$(eval …)`` of ROS 2. Everything that is not in the
tables here is unknown, with the reason; size and steps are bounded.
"""

from __future__ import annotations

import ast
import builtins
import math
import operator
import re
import warnings
from collections.abc import Callable, Mapping
from typing import Any

Plain = str | int | float | bool | None | tuple["Plain", ...] | dict[str, "Plain"]
"""A value of an expression; lists are tuples."""
Function = Callable[..., Plain]

MOST_STEPS = 2_000
MOST_LENGTH = 10_000
_MOST_DEPTH = 60
_MOST_NUMBER = 10**30
_WIDE = re.compile(r"%[^%a-zA-Z]*(\*|\d{4})")
"""A format that makes a text of any length."""


class UnknownError(ValueError):
    """What cannot be evaluated; the text is the reason."""


class FailsError(UnknownError):
    """What Python ends with an error; the text is the reason."""


_BINARY: dict[type[ast.operator], Callable[..., object]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}
_COMPARE: dict[type[ast.cmpop], Callable[..., object]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda item, whole: item in whole,
    ast.NotIn: lambda item, whole: item not in whole,
    ast.Is: lambda one, other: one is other or (one == other and type(one) is type(other)),
    ast.IsNot: lambda one, other: not (one is other or (one == other and type(one) is type(other))),
}
_FUNCTIONS: dict[str, Callable[..., object]] = {
    "str": str, "int": int, "float": float, "bool": bool, "len": len, "abs": abs, "min": min, "max": max,
    "round": round, "list": tuple, "tuple": tuple, "sorted": lambda items: tuple(sorted(items)),
    "any": any, "all": all, "sum": sum,
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "sqrt": math.sqrt, "radians": math.radians,
    "degrees": math.degrees, "floor": math.floor, "ceil": math.ceil, "fabs": math.fabs, "atan2": math.atan2,
}  # fmt: skip
_METHODS = frozenset(
    {"lower", "upper", "strip", "lstrip", "rstrip", "split", "startswith", "endswith", "replace", "join", "title",
     "capitalize", "isdigit", "find", "count"}
)  # fmt: skip
_TRUTHS: dict[str, Plain] = {"true": True, "false": False}
"""Names that roslaunch knows, and that are none of Python."""
_CONSTANTS: dict[str, Plain] = {"pi": math.pi, "e": math.e}
_NAMED = frozenset({*dir(builtins), *dir(math), "math"})
"""Names that Python, or the module that launch hands to it, have besides those that are evaluated here."""


def evaluate(
    expression: str,
    names: Mapping[str, Plain] | None = None,
    functions: Mapping[str, Function] | None = None,
    *,
    truths: bool = True,
) -> Plain:
    """Return the value of an expression.

    Args:
        expression: in the syntax of Python.
        names: values by name.
        functions: that it may call, besides conversions and mathematics; they raise :class:`UnknownError` likewise.
        truths: whether ``true`` and ``false`` are names, as they are to roslaunch and not to launch.

    Raises:
        UnknownError: it cannot be evaluated.
        FailsError: Python cannot evaluate it either.
    """
    if len(expression) > MOST_LENGTH:
        raise UnknownError(f"an expression of {len(expression):,} characters")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(expression.strip(), mode="eval")
        known = {**_CONSTANTS, **(_TRUTHS if truths else {}), **(names or {})}
        return _Evaluation(known, functions or {}).of(tree.body, 0)
    except SyntaxError as error:
        raise FailsError(f"{expression!r} is not a Python expression (SyntaxError: {error.msg})") from None
    except (RecursionError, MemoryError) as error:
        raise UnknownError(f"{expression!r} is not a Python expression ({type(error).__name__})") from None
    except UnknownError:
        raise
    except (ArithmeticError, TypeError, ValueError, LookupError, AttributeError) as error:
        raise FailsError(f"{expression!r} fails: {type(error).__name__}: {error}") from None


class _Evaluation:
    def __init__(self, names: Mapping[str, Plain], functions: Mapping[str, Function]) -> None:
        self._names = names
        self._functions = functions
        self._steps = 0

    def of(self, node: ast.expr, depth: int) -> Plain:
        self._steps += 1
        if self._steps > MOST_STEPS or depth > _MOST_DEPTH:
            raise UnknownError("it takes too many steps")
        for kind, method in _KINDS:
            if isinstance(node, kind):
                return method(self, node, depth + 1)
        raise _not_evaluated(node)

    def constant(self, node: ast.Constant, _depth: int) -> Plain:
        return _bounded(node.value)

    def attribute(self, node: ast.Attribute, _depth: int) -> Plain:
        if isinstance(node.value, ast.Name) and node.value.id == "math" and node.attr in _CONSTANTS:
            return _CONSTANTS[node.attr]
        raise _not_evaluated(node)

    def chosen(self, node: ast.IfExp, depth: int) -> Plain:
        return self.of(node.body if self.of(node.test, depth) else node.orelse, depth)

    def sequence(self, node: ast.List | ast.Tuple | ast.Set, depth: int) -> Plain:
        return tuple(self.of(item, depth) for item in node.elts)

    def name(self, node: ast.Name, _depth: int) -> Plain:
        if node.id in self._names:
            return self._names[node.id]
        if node.id in _NAMED or node.id in self._functions:
            raise UnknownError(f"the name {node.id!r} is unknown")
        raise FailsError(f"the name {node.id!r} is not defined")

    def binary(self, node: ast.BinOp, depth: int) -> Plain:
        left, right = self.of(node.left, depth), self.of(node.right, depth)
        function = _BINARY.get(type(node.op))
        if function is None:
            raise _not_evaluated(node)
        match node.op:
            case ast.Mult() if max(_size(left) * _times(right), _size(right) * _times(left)) > MOST_LENGTH:
                raise UnknownError("it creates a string that is too long")
            case ast.Mod() if isinstance(left, str) and _WIDE.search(left):
                raise UnknownError(f"the format {left!r} is not evaluated")
        return _bounded(function(left, right))

    def unary(self, node: ast.UnaryOp, depth: int) -> Plain:
        value = self.of(node.operand, depth)
        if isinstance(node.op, ast.Not):
            return not value
        if isinstance(value, (int, float)):
            return -value if isinstance(node.op, ast.USub) else +value
        raise _not_evaluated(node)

    def boolean(self, node: ast.BoolOp, depth: int) -> Plain:
        stops = isinstance(node.op, ast.Or)
        value: Plain = None
        for operand in node.values:
            value = self.of(operand, depth)
            if bool(value) is stops:
                break
        return value

    def compared(self, node: ast.Compare, depth: int) -> Plain:
        left = self.of(node.left, depth)
        for compare, operand in zip(node.ops, node.comparators, strict=True):
            right = self.of(operand, depth)
            if not _COMPARE[type(compare)](left, right):
                return False
            left = right
        return True

    def dictionary(self, node: ast.Dict, depth: int) -> Plain:
        found: dict[str, Plain] = {}
        for key, value in zip(node.keys, node.values, strict=True):
            name = self.of(key, depth) if key is not None else None
            if not isinstance(name, str):
                raise _not_evaluated(node)
            found[name] = self.of(value, depth)
        return found

    def joined(self, node: ast.JoinedStr, depth: int) -> Plain:
        pieces = []
        for part in node.values:
            match part:
                case ast.FormattedValue():
                    if part.format_spec is not None:
                        raise _not_evaluated(node)
                    value = self.of(part.value, depth)
                    pieces.append(repr(value) if part.conversion == ord("r") else str(value))
                case _:
                    pieces.append(str(self.of(part, depth)))
        return _bounded("".join(pieces))

    def item(self, node: ast.Subscript, depth: int) -> Plain:
        whole = self.of(node.value, depth)
        if isinstance(node.slice, ast.Slice):
            if not isinstance(whole, (str, tuple)):
                raise _not_evaluated(node)
            lower = self.of(node.slice.lower, depth) if node.slice.lower else None
            upper = self.of(node.slice.upper, depth) if node.slice.upper else None
            if node.slice.step or not isinstance(lower, int | None) or not isinstance(upper, int | None):
                raise _not_evaluated(node)
            return whole[lower:upper]
        key = self.of(node.slice, depth)
        match whole:
            case dict() if isinstance(key, str):
                return whole[key]
            case str() | tuple() if isinstance(key, int):
                return whole[key]
        raise _not_evaluated(node)

    def call(self, node: ast.Call, depth: int) -> Plain:
        if node.keywords or any(isinstance(argument, ast.Starred) for argument in node.args):
            raise _not_evaluated(node)
        arguments = [self.of(argument, depth) for argument in node.args]
        called = node.func
        name = called.id if isinstance(called, ast.Name) else called.attr if isinstance(called, ast.Attribute) else ""
        if isinstance(called, ast.Attribute) and not (isinstance(called.value, ast.Name) and called.value.id == "math"):
            return _bounded(_method(self.of(called.value, depth), name, arguments))
        if name in self._functions:
            return self._functions[name](*arguments)
        if name in _FUNCTIONS:
            return _bounded(_FUNCTIONS[name](*arguments))
        raise _not_evaluated(node)


_KINDS: tuple[tuple[Any, Callable[[_Evaluation, Any, int], Plain]], ...] = (
    (ast.Constant, _Evaluation.constant),
    (ast.Name, _Evaluation.name),
    (ast.BinOp, _Evaluation.binary),
    (ast.UnaryOp, _Evaluation.unary),
    (ast.BoolOp, _Evaluation.boolean),
    (ast.Compare, _Evaluation.compared),
    (ast.IfExp, _Evaluation.chosen),
    ((ast.List, ast.Tuple, ast.Set), _Evaluation.sequence),
    (ast.Dict, _Evaluation.dictionary),
    (ast.JoinedStr, _Evaluation.joined),
    (ast.Subscript, _Evaluation.item),
    (ast.Call, _Evaluation.call),
    (ast.Attribute, _Evaluation.attribute),
)


def _not_evaluated(node: ast.expr) -> UnknownError:
    return UnknownError(f"{ast.unparse(node)!r} is not evaluated here")


def _method(receiver: Plain, name: str, arguments: list[Plain]) -> object:
    if name == "get" and isinstance(receiver, dict) and arguments and isinstance(arguments[0], str):
        return receiver.get(arguments[0], arguments[1] if len(arguments) > 1 else None)
    if not isinstance(receiver, str) or name not in _METHODS:
        raise UnknownError(f"{receiver!r}.{name} is not evaluated here")
    if name in ("replace", "join") and len(receiver) * max([_size(one) for one in arguments], default=0) > MOST_LENGTH:
        raise UnknownError("it creates a string that is too long")
    return getattr(receiver, name)(*arguments)


def _times(value: Plain) -> int:
    return max(int(value), 1) if isinstance(value, int) else 1


def _size(value: Plain) -> int:
    return len(value) if isinstance(value, (str, tuple)) else 0


def _bounded(value: object) -> Plain:
    if isinstance(value, list):
        value = tuple(value)
    match value:
        case str() | tuple() if len(value) > MOST_LENGTH:
            raise UnknownError("it creates a string that is too long")
        case int() if abs(value) > _MOST_NUMBER:
            raise UnknownError("it creates a number that is too large")
    if value is None or isinstance(value, (str, int, float, tuple, dict)):
        return value
    raise UnknownError(f"a {type(value).__name__} is not evaluated")
