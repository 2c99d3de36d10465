"""Operators while source is evaluated: choices, ``and`` and ``or``, comparisons, arithmetic."""

from __future__ import annotations

from collections.abc import Callable as Function1
from typing import TYPE_CHECKING, Any

from roslens.source.extract.domain.abstract_value import Named, Unknown, Value, as_text, test_of
from roslens.source.extract.domain.frame import one_of, one_or_none
from roslens.source.extract.domain.kinds import text_of
from roslens.source.extract.domain.plain_methods import formatted
from roslens.source.extract.domain.text_choice import either
from roslens.source.extract.domain.word_list import AtLeast
from roslens.source.extract.ir.program import Expression, Operation
from roslens.source.extract.symbolic.condition import negated
from roslens.source.extract.symbolic.text import And, AreEqual, Condition, Or, Text, unknown
from roslens.source.extract.transfer.short_circuit import after_others, does_something, way_of

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

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
    match one, other, decides:
        case Text(known="true"), Text(known="false"), Text():
            return decides
        case (Text(), Text() | Unknown(), _) | (Unknown(), Text(), _):
            return either(as_text(one), as_text(other), condition, test_of(decides))
    both = one_of(one, other, condition, test_of(decides))
    if both is not None:
        return both
    match one, other:
        case (None, _) | (_, None):
            return one_or_none(one, other, condition, test_of(decides))
        case Unknown() | bool() | int() | float(), Unknown() | bool() | int() | float():
            # Neither is taken for the other: what is counted or asked later depends on which one it is.
            return one if type(one) is type(other) and one == other else opened(ctx, expression)
        case Unknown(), _:
            return other
    return one


def decided(ctx: Context, expression: Operation) -> Value:
    """Return what decides ``and`` or ``or``: in Python one of the operands, in C++ whether it holds."""
    results = ctx.dialect.operands_are_results
    operator, operands = expression.operator, expression.operands
    stops = operator == "or"
    open_: list[tuple[Value, Expression]] = []
    value: Value = not stops
    for number, one in enumerate(operands):
        value = after_others(ctx, one, open_, operator)
        holds = ctx.truth(value)
        if holds is stops:
            break
        if holds is not None:
            continue
        open_.append((value, one))
        text = text_of(value) if results and stops else None
        if text is not None and number < len(operands) - 1:
            return _or_else(ctx, text, operands[number:])
    if open_:
        return _decided_by(ctx, expression, value, [one for one, _ in open_])
    holds = ctx.truth(value)
    return value if results or holds is None else holds


def _decided_by(ctx: Context, expression: Operation, last: Value, open_: list[Value]) -> Value:
    """Return what ``and`` or ``or`` comes to where some operands are open; ``last`` is the last one that counts."""
    stops = expression.operator == "or"
    if ctx.truth(last) is stops:
        return stops if not ctx.dialect.operands_are_results or last is stops else opened(ctx, expression)
    tests = [test for one in open_ if (test := test_of(one)) is not None]
    test = tests[0] if len(tests) == 1 else (Or if stops else And)(tuple(tests))
    return opened(ctx, expression, test if len(tests) == len(open_) else None)


def opened(ctx: Context, expression: Expression, test: Condition | None = None) -> Unknown:
    """Return that an expression is open, with what decides it where that is known."""
    return Unknown(ctx.index.memo.text(expression), test)


def _or_else(ctx: Context, value: Text, operands: tuple[Expression, ...]) -> Value:
    """Return a text, or where it is empty what comes after ``or``."""
    rest = ctx.value(Operation("or", operands[1:]) if len(operands) > 2 else operands[1])
    other = text_of(rest)
    if other is None:
        other = unknown(as_text(rest).holes[0].reason if rest else "nothing")
    return either(value, other, ctx.index.memo.condition(operands[0]), test_of(value))


def computed(ctx: Context, operator: str, values: list[Value], expression: Operation) -> Value:
    """Return what an operator makes of values."""
    match values:
        case [dict() as one, dict() as other] if operator == "|":
            return {**one, **other}
        case [one, other]:
            of_two = _equal if operator == "==" or operator == "!=" else _of_two
            return of_two(ctx, operator, one, other, expression)
        case [int() | float() as number] if operator == "-":
            return -number
    return opened(ctx, expression)


def _equal(ctx: Context, operator: str, one: Value, other: Value, expression: Operation) -> Value:
    """Return whether two values are equal, or are not."""
    match _comparable(one), _comparable(other):
        case ((str() | int() | float() as first), (str() | int() | float() as second)):
            return (first == second) is (operator == "==")
    return opened(ctx, expression, _compared(operator, [one, other]))


def _of_two(ctx: Context, operator: str, one: Value, other: Value, expression: Operation) -> Value:
    """Return what an operator makes of two values that it does not compare for being equal."""
    match one:
        case int() | float() as number:
            match other:
                case int() | float():
                    return _calculated(ctx, operator, number, other, expression)
        case AtLeast():
            found = one.compared(operator, other)
            return opened(ctx, expression) if found is None else found
        case Text() if operator == "%":
            match other:
                case list():
                    return formatted(one, other)
            return formatted(one, [other])
    return opened(ctx, expression)


def _calculated(ctx: Context, operator: str, one: float, other: float, expression: Operation) -> Value:
    """Return what an operator makes of numbers."""
    function = _NUMBERS.get(operator)
    try:
        return function(one, other) if function else opened(ctx, expression)
    except (ArithmeticError, ValueError):
        return opened(ctx, expression)


def _compared(operator: str, values: list[Value]) -> Condition | None:
    """Return what decides a comparison that is open, where texts are compared."""
    match values:
        case [Text() | str() | int() | float() as first, Text() | str() | int() | float() as second]:
            one, other = as_text(first), as_text(second)
            test = AreEqual(one, other)
            return None if not one.holes and not other.holes else test if operator == "==" else negated(test)
    return None


def _comparable(value: Value) -> Value:
    """Return a value as it compares: what is not found is at ``npos``."""
    match value:
        case Text():
            return value.known
        case Named() if value.name.endswith("string.npos"):
            return -1
    return value
