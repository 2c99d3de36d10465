"""Operands that are evaluated only where another one holds: ``on && set(topic)``, ``on ? make("a") : make("b")``.

Few of them do anything but ask. What one changes that calls a function of the workspace is the one or the other after
it, and what is made in it keeps the condition.
"""

from __future__ import annotations

from collections.abc import Sequence as SequenceOf
from typing import TYPE_CHECKING, Any

from roslens.source.extract.domain.abstract_value import Callable, Names, QosValue, Value, test_of
from roslens.source.extract.domain.frame import join
from roslens.source.extract.ir.program import Call, Expression, Item, Member, Name, Operation, Sequence
from roslens.source.extract.symbolic.condition import ALWAYS, all_of, negated
from roslens.source.extract.symbolic.text import And, Condition, Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def does_something(ctx: Context, operand: Expression) -> bool:
    """Whether an operand calls a function of the workspace, by its name."""
    if type(operand) is not Call and type(operand) is not Operation:
        return False
    memo = ctx.index.memo
    names = memo.called.get(id(operand))
    if names is None or names[0] is not operand:
        names = memo.called[id(operand)] = (operand, _called(operand))
    if not names[1]:
        return False
    known = memo.whole.function_names
    if known is None:
        programs = ctx.index.every_program()
        known = memo.whole.function_names = {one.name for each in programs for one in each.functions if one.body}
    local = ctx.state.frame.names
    for one in names[1]:  # noqa: SIM110 - a generator costs more than the search
        if one in known or (one in local and type(local[one]) is Callable):
            return True
    return False


def _called(operand: Expression) -> tuple[str, ...]:
    """Return the last names of what is called in an expression."""
    found: set[str] = set()
    waiting: list[Any] = [operand]
    for one in waiting:
        kind = type(one)
        if kind is Call:
            called = one.function
            if type(called) is Name:
                found |= {called.name.rpartition(".")[2]}
            else:
                found |= {called.name} if type(called) is Member else set()
                waiting += (called,)
            waiting += one.arguments
        elif kind is Operation:
            waiting += one.operands
        elif kind is Member or kind is Item:
            waiting += (one.of,)
        elif kind is Sequence:
            waiting += one.items
    return tuple(sorted(found))


def value_if(
    ctx: Context, operand: Expression, condition: Condition, test: Condition | None, *, noted: bool = True
) -> Value:
    """Return the value of an operand that is evaluated where a condition holds.

    Args:
        ctx: the evaluation.
        operand: whose value is asked for.
        condition: under which it is evaluated.
        test: what decides that, where it is known.
        noted: whether what is made in it keeps the condition.
    """
    frame, changes, here = ctx.state.frame, ctx.state.store, len(ctx.state.conditions)
    before, since = frame.snapshot(), changes.count
    changes.open += 1
    if noted:
        ctx.state.under(condition, test)
    try:
        value = ctx.value(operand)
    finally:
        del ctx.state.conditions[here:]
        changes.open -= 1
    if not frame.is_as(before):
        _may_be_as(frame.names, before[0], condition, test)
        if frame.members is not None:
            _may_be_as(frame.members, before[1], condition, test)
    if changes.count > since:
        way = changes.roll_back(since, frame.members)
        changes.merge(way, changes.count, frame.members, (False, False), (condition, ALWAYS), test)
    if not changes.open and changes.count:
        changes.ended()
    return value


def way_of(ctx: Context, operand: Expression, condition: Condition, decides: Value, *, opposite: bool = False) -> Value:
    """Return the value of one of two operands of which a condition chooses; the second one with ``opposite``."""
    test = test_of(decides)
    if opposite:
        condition, test = negated(condition), None if test is None else negated(test)
    return value_if(ctx, operand, condition, test)


def after_others(
    ctx: Context, operand: Expression, others: SequenceOf[tuple[Value, Expression]], operator: str
) -> Value:
    """Return the value of an operand of ``and`` or ``or`` that comes after others whose truth is unknown.

    Where one of these does something itself, that it went well is no condition worth reporting.
    """
    if not others or not does_something(ctx, operand):
        return ctx.value(operand)
    conditions = [ctx.index.memo.condition(one) for _, one in others]
    if operator == "or":
        conditions = [negated(one) for one in conditions]
    tests = [test if operator == "and" else negated(test) for value, _ in others if (test := test_of(value))]
    test = None
    if len(tests) == len(others):
        test = tests[0] if len(tests) == 1 else And(tuple(tests))
    asks = not any(does_something(ctx, one) for _, one in others)
    return value_if(ctx, operand, all_of(conditions), test, noted=asks)


def _may_be_as(now: Names, before: Names, condition: Condition, test: Condition | None) -> None:
    """Let names hold what they were, or what they are now where a condition holds; what was not known stays as now."""
    changed = {
        name: value
        for name, was in before.items()
        if (value := now.get(name)) is not was and _is_known(was) and name in now
    }
    for name in changed:
        now[name] = before[name]
    join(now, changed, condition, test)


def _is_known(value: Value) -> bool:
    match value:
        case Text():
            return bool(value.known) or any(hole.parameter for hole in value.holes)
        case bool() | int() | float() | QosValue() | list() | dict():
            return True
    return False
