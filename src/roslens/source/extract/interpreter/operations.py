"""Operators while source is evaluated: choices, ``and`` and ``or``, comparisons, arithmetic."""

from __future__ import annotations

from collections.abc import Callable as Function1
from typing import TYPE_CHECKING, Any

from roslens.source.extract.domain.abstract_value import Named, Unknown, Value, as_text, test_of
from roslens.source.extract.domain.frame import either, one_of, one_or_none
from roslens.source.extract.domain.plain_methods import formatted
from roslens.source.extract.domain.word_list import AtLeast
from roslens.source.extract.ir.program import Expression, Operation
from roslens.source.extract.symbolic.condition import negated
from roslens.source.extract.symbolic.text import And, AreEqual, Condition, Or, Text, unknown
from roslens.source.extract.transfer.short_circuit import after_others, does_something, way_of

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

# Written once: a union that is written in a call is made in each call.
_NUMBER = (int, float)
_PLAIN = (str, int, float, bool)
_COMPARED = (Text, str, int, float)
_DECIDES = (Unknown, bool, int, float)
_NUMBERS: dict[str, Function1[[Any, Any], Any]] = {
    "-": lambda one, other: one - other,
    "*": lambda one, other: one * other,
    "/": lambda one, other: one / other,
    "%": lambda one, other: one % other,
    "<": lambda one, other: one < other,
    ">": lambda one, other: one > other,
    "<=": lambda one, other: one <= other,
    ">=": lambda one, other: one >= other,
    "//": lambda one, other: one // other,
}


def chosen(ctx: Context, expression: Operation, decides: Value) -> Value:
    """Return one of two values, or what is known of both: ``decides`` is what the condition comes to."""
    condition = ctx.index.memo.condition(expression.operands[0])
    then, otherwise = expression.operands[1:]
    one = way_of(ctx, then, condition, decides) if does_something(ctx, then) else ctx.value(then)
    if does_something(ctx, otherwise):
        other = way_of(ctx, otherwise, condition, decides, opposite=True)
    else:
        other = ctx.value(otherwise)
    if isinstance(one, Text) and isinstance(other, Text):
        if (one.known, other.known) == ("true", "false") and isinstance(decides, Text):
            return decides
        return either(one, other, condition, test_of(decides))
    texts = isinstance(one, Text | Unknown) and isinstance(other, Text | Unknown)
    if texts and isinstance(one, Text) is not isinstance(other, Text):
        return either(as_text(one), as_text(other), condition, test_of(decides))
    both = one_of(one, other, condition, test_of(decides))
    if both is not None:
        return both
    if one is None or other is None:
        return one_or_none(one, other, condition, test_of(decides))
    if isinstance(one, _DECIDES) and isinstance(other, _DECIDES):
        # Neither is taken for the other: what is counted or asked later depends on which one it is.
        return one if type(one) is type(other) and one == other else opened(ctx, expression)
    return one if not isinstance(one, Unknown) else other


def decided(ctx: Context, expression: Operation) -> Value:
    """Return what decides ``and`` or ``or``: in Python one of the operands, in C++ whether it holds."""
    results = ctx.dialect.operands_are_results
    operator, operands = expression.operator, expression.operands
    stops = operator == "or"
    open_: list[tuple[Value, Expression]] = []
    value: Value = not stops
    for number, one in enumerate(operands):
        ways = open_ and does_something(ctx, one)
        value = after_others(ctx, one, open_, operator) if ways else ctx.value(one)
        holds = ctx.truth(value)
        if holds is stops:
            break
        if holds is None:
            open_.append((value, one))
            if results and stops and number < len(operands) - 1 and isinstance(value, Text):
                return _or_else(ctx, value, operands[number:])
    if not open_:
        holds = ctx.truth(value)
        return value if results or holds is None else holds
    if ctx.truth(value) is stops:
        return stops if not results or isinstance(value, bool) else opened(ctx, expression)
    tests = [test for one, _ in open_ if (test := test_of(one)) is not None]
    test = tests[0] if len(tests) == 1 else (And if operator == "and" else Or)(tuple(tests))
    return opened(ctx, expression, test if len(tests) == len(open_) else None)


def opened(ctx: Context, expression: Expression, test: Condition | None = None) -> Unknown:
    """Return that an expression is open, with what decides it where that is known."""
    return Unknown(ctx.index.memo.text(expression), test)


def _or_else(ctx: Context, value: Text, operands: tuple[Expression, ...]) -> Value:
    """Return a text, or where it is empty what comes after ``or``."""
    rest = ctx.value(Operation("or", operands[1:]) if len(operands) > 2 else operands[1])
    other = rest if isinstance(rest, Text) else unknown(as_text(rest).holes[0].reason if rest else "nothing")
    return either(value, other, ctx.index.memo.condition(operands[0]), test_of(value))


def computed(ctx: Context, operator: str, values: list[Value], expression: Operation) -> Value:
    """Return what an operator makes of values."""
    if len(values) == 2 and operator in ("==", "!="):
        one, other = (_comparable(value) for value in values)
        plain = isinstance(one, _PLAIN) and isinstance(other, _PLAIN)
        if plain and not any(isinstance(value, Text) and value.known is None for value in values):
            return (one == other) is (operator == "==")
        return opened(ctx, expression, _compared(operator, values))
    if len(values) == 2 and isinstance(values[0], AtLeast):
        found = values[0].compared(operator, values[1])
        return opened(ctx, expression) if found is None else found
    if len(values) == 2 and operator == "%" and isinstance(values[0], Text):
        return formatted(values[0], values[1] if isinstance(values[1], list) else [values[1]])
    if len(values) == 2 and isinstance(values[0], _NUMBER) and isinstance(values[1], _NUMBER):
        function = _NUMBERS.get(operator)
        try:
            return function(*values) if function else opened(ctx, expression)
        except (ArithmeticError, ValueError):
            return opened(ctx, expression)
    if operator == "-" and len(values) == 1 and isinstance(values[0], _NUMBER):
        return -values[0]
    return opened(ctx, expression)


def _compared(operator: str, values: list[Value]) -> Condition | None:
    """Return what decides a comparison that is open, where texts are compared."""
    texts = [as_text(one) for one in values if isinstance(one, _COMPARED)]
    if len(texts) < len(values) or not any(one.holes for one in texts):
        return None
    test = AreEqual(texts[0], texts[1])
    return test if operator == "==" else negated(test)


def _comparable(value: Value) -> Value:
    """Return a value as it compares: what is not found is at ``npos``."""
    if isinstance(value, Text):
        return value.known
    return -1 if isinstance(value, Named) and value.name.endswith("string.npos") else value
