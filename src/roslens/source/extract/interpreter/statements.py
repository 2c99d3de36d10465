"""Statements while source is evaluated: branches, what is returned, and how constructors initialise."""

from __future__ import annotations

from collections.abc import Callable as Function1
from typing import TYPE_CHECKING, Any

import msgspec

from roslens.source.extract.domain.abstract_value import (
    Names,
    Obj,
    Unknown,
    Value,
    test_of,
)
from roslens.source.extract.domain.earlier_values import forget_defaults
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.domain.kinds import items_of, text_of
from roslens.source.extract.domain.owned_pointer import owns_first
from roslens.source.extract.interpreter.assignments import assigned
from roslens.source.extract.interpreter.loops import block_of_loop, left, looped, without_ways_out
from roslens.source.extract.interpreter.objects import is_list, is_pointer
from roslens.source.extract.ir.program import (
    NO_BREAK,
    Assign,
    Branch,
    Call,
    Evaluate,
    Expression,
    Leave,
    Loop,
    Member,
    Name,
    Operation,
    Return,
    Sequence,
    Statement,
)
from roslens.source.extract.ir.set_again import forget_set_again
from roslens.source.extract.symbolic.condition import negated
from roslens.source.extract.symbolic.text import Condition, NoException
from roslens.source.extract.symbols.declared_field import declared_field
from roslens.source.extract.symbols.symbol_table import type_arguments, type_name
from roslens.source.extract.transfer.static_storage import returned

if TYPE_CHECKING:
    from roslens.source.extract.domain.frame import Held
    from roslens.source.extract.transfer.context import Context


class _Ended(msgspec.Struct, frozen=True):
    """How one way of an open condition ended.

    Attributes:
        condition: under which it is taken.
        returned: whether it returned for sure.
        gone: whether it returned, or left the turn of the loop around, for sure.
        plainly: whether its return reported no failure.
    """

    condition: Condition
    returned: bool
    gone: bool
    plainly: bool


def initialise(ctx: Context, statement: Statement) -> None:
    """Evaluate an initialiser of a constructor: of a member, or of a base."""
    match statement:
        case Evaluate(expression=Call() as call):
            arguments = [ctx.value(one) for one in call.arguments]
            ctx.state.at(call)
            _initialise_base(ctx, call, arguments, {})
        case Assign(target=Member(name=name)) if statement.value is not None:
            thing = ctx.state.frame.object
            declared = declared_field(ctx.index, thing.defined, name) if thing is not None else ""
            value = ctx.value(statement.value)
            ctx.state.written_at(statement.line)
            match statement.value:
                case Sequence():
                    value = _initialised_with(ctx, name, declared, value)
                case _ if declared:
                    value = ctx.objects.constructed(declared, value)
            if thing is not None:
                thing.fields[name] = value


def _initialised_with(ctx: Context, name: str, declared: str, value: Value) -> Value:
    """Return a member that is initialised with the items of a list, as its declared type makes it."""
    kind, inside = type_name(declared)
    items = items_of(value)
    if "ptr" in declared.lower() and owns_first(items):
        return items[0]
    if not items and is_pointer(declared):
        return None
    if not is_list(declared):
        return ctx.objects.of_type(kind, list(items), {}, tuple(type_arguments(inside)))
    match items:
        case [int() | float(), *_] if inside.endswith("string"):
            return Unknown(f"{name}, one of many strings")
    return value


def _initialise_base(ctx: Context, call: Call, arguments: list[Value], keywords: Names) -> None:
    """Construct a base, or delegate to another constructor of the class."""
    thing = ctx.state.frame.object
    match call.function:
        case Name(name=written) if thing is not None:
            pass
        case _:
            return
    scope, _, last = written.rpartition(".")
    # ``Base::Base(…)`` names the constructor.
    written = scope if scope.rpartition(".")[2] == last else written
    written = _base_named(ctx, thing, written)
    base = ctx.index.class_of(written, ctx.state.frame.path, ctx.state.frame.scope)
    if base is not None:
        names = base.what.templates
        if call.templates:
            given = dict(zip(names, (ctx.calls.template(one) for one in call.templates), strict=False))
            thing.base_templates[base.what.qualified_name] = given
    if base is None:
        name = ctx.index.meaning(written, ctx.state.frame.path, ctx.state.frame.scope)
        bases = ctx.index.outer_bases(thing.defined) if thing.defined is not None else []
        name = next((one for one in bases if one.rpartition(".")[2] == name), name)
        ctx.calls.construct_outer(thing, name, arguments, keywords)
    else:
        ctx.objects.construct_as(thing, base, arguments, keywords)


def _base_named(ctx: Context, thing: Obj, written: str) -> str:
    """Return a base as its class writes it: its last name is known there, whatever else has that name elsewhere."""
    inside = ctx.state.frame.scope.rpartition(".")[0]
    for one in ctx.index.chain(thing.defined) if thing.defined is not None and "." not in written else ():
        if one.what.qualified_name == inside:
            bases = one.what.bases
            return next((base for base in bases if base.rpartition(".")[2] == written), written)
    return written


def block(ctx: Context, body: tuple[Statement, ...]) -> None:
    """Follow statements in order."""
    frame, before = ctx.state.frame, len(ctx.state.conditions)
    try:
        for statement in body:
            ctx.budget.spend()
            _STATEMENTS[type(statement)](ctx, statement)
            if frame.returned or frame.stopped:
                return
    finally:
        frame.passed -= len(ctx.state.conditions) - before
        del ctx.state.conditions[before:]


def _evaluated(ctx: Context, statement: Evaluate) -> None:
    ctx.value(statement.expression)
    match statement.expression:
        case Call(function=Name(name="throw")):
            if len(ctx.state.conditions) > ctx.state.frame.depth + ctx.state.frame.passed:
                # Elsewhere a condition that is taken for true may be none: nothing is left out for its sake.
                ctx.state.frame.returned, ctx.state.frame.plainly = True, False


def _returned_value(ctx: Context, written: Expression) -> Value:
    value = ctx.value(written)
    return ctx.state.frame.as_returned(value, open_=len(ctx.state.conditions) > ctx.state.frame.depth)


def _returned(ctx: Context, statement: Return) -> None:
    value = None if statement.value is None else _returned_value(ctx, statement.value)
    returned(ctx, statement)
    ctx.state.frame.give(value, ctx.state.conditions[ctx.state.frame.depth :])
    ctx.state.frame.plainly = value is None or value is True or (value == 0 and value is not False)


def _holds(ctx: Context, statement: Branch, decides: Value) -> bool | None:
    """Return whether a condition holds; None where that is unknown."""
    if statement.condition == NO_BREAK:
        broken = ctx.state.frame.broken
        return None if broken is None else not broken
    return ctx.truth(decides)


def _branched(ctx: Context, statement: Branch) -> None:
    decides = ctx.value(statement.condition)
    holds = _holds(ctx, statement, decides)
    if holds is None:
        _both_ways(ctx, statement, decides)
        return
    follow = block if ctx.state.frame.ways is None else block_of_loop
    follow(ctx, statement.then if holds else statement.otherwise)


def _both_ways(ctx: Context, statement: Branch, decides: Value) -> None:
    """Follow both ways of a condition that is open, each from the same start, and join what they came to."""
    frame, changes = ctx.state.frame, ctx.state.store
    written = ctx.index.memo.condition(statement.condition)
    otherwise = negated(written)
    before, exits = frame.snapshot(), len(frame.ways.out) if frame.ways else 0
    since = changes.count
    changes.open += 1
    frame.know(written, otherwise, test_of(decides))
    _tried_or_noted(ctx, written, statement.then)
    first = _ended(frame, written)
    after = before if frame.is_as(before) else frame.snapshot()
    frame.restore(before)
    frame.returned = frame.stopped = False
    second_begins = changes.count
    taken_back = changes.roll_back(since, frame.members) if second_begins > since else {}
    _follow_second(ctx, statement, (before, after), (written, otherwise))
    second = _ended(frame, otherwise)
    gone = (first.gone, second.gone)
    if taken_back or changes.count > second_begins:
        test = frame.tests.get(written)
        changes.merge(taken_back, second_begins, frame.members, gone, (written, otherwise), test)
    changes.close()
    if first.returned is not second.returned:
        _leave_by_one(frame, (first, second), before, after)
    _hold_after(frame, after, written, gone, changed=after is not before or bool(statement.otherwise))
    frame.returned = first.returned and second.returned
    frame.stopped = first.gone and second.gone and not frame.returned
    _note_passed(ctx, statement, first, second)
    without_ways_out(ctx, exits)


def _ended(frame: Frame, condition: Condition) -> _Ended:
    return _Ended(condition, frame.returned, frame.returned or frame.stopped, frame.plainly)


def _follow_second(
    ctx: Context, statement: Branch, held: tuple[Held, Held], notes: tuple[Condition, Condition]
) -> None:
    """Follow what is done where a condition does not hold; ``held`` is what names held before and after the other."""
    if not statement.otherwise:
        return
    if type(notes[0]) is NoException and held[1] is not held[0]:
        _handled(ctx, statement, held, notes)
    else:
        _noted(ctx, notes[1], statement.otherwise)


def _leave_by_one(frame: Frame, ways: tuple[_Ended, _Ended], before: Held, after: Held) -> None:
    """Remember what members of the object hold where only one of two ways leaves the function."""
    first, second = ways
    if second.returned:
        frame.leave(dict(frame.members or {}), before[1], second.condition)
    elif after is not before:
        frame.leave(after[1], before[1], first.condition)


def _note_passed(ctx: Context, statement: Branch, first: _Ended, second: _Ended) -> None:
    """Let what follows know by which way it is reached, where it is by one alone."""
    frame = ctx.state.frame
    if first.gone is second.gone:
        return
    passed = second.condition if first.gone else first.condition
    if ctx.emitter.node.generation == "ros1":
        forget_defaults(frame, frame.tests.get(passed))
    if first.returned and first.plainly and _asks_parameter(ctx, statement.condition):
        # What follows is reached only where the function was not left.
        ctx.state.under(passed, frame.tests.get(passed))
        frame.passed += 1


def _tried_or_noted(ctx: Context, written: Condition, body: tuple[Statement, ...]) -> None:
    if type(written) is NoException:
        block(ctx, body)
    else:
        _noted(ctx, written, body)


def _hold_after(frame: Frame, after: Held, written: Condition, gone: tuple[bool, bool], *, changed: bool) -> None:
    """Let names hold what they do after a branch: a way that leaves the function, or the loop, has no say in that."""
    if gone == (False, True):
        frame.restore(after)
    elif gone[0] is gone[1] and changed:
        frame.join(after, written)


def _handled(ctx: Context, tried: Branch, held: tuple[Held, Held], notes: tuple[Condition, Condition]) -> None:
    """Follow handlers of exceptions: in them may hold what was set until the exception came."""
    frame, (before, after) = ctx.state.frame, held
    frame.join(after, notes[0])
    now_held = (frame.names, frame.members or {})
    lost = [forget_set_again(tried.then, now, was) for now, was in zip(now_held, before, strict=True)]
    begun = frame.snapshot()
    _noted(ctx, notes[1], tried.otherwise)
    for now, first, was, gone in zip(now_held, begun, before, lost, strict=True):
        for name in [name for name, value in first.items() if now.get(name) is value is not was.get(name)]:
            if name in gone:
                continue
            # What they leave alone is what it was where there was an exception, or what it came to.
            if name in was:
                now[name] = was[name]
            else:
                del now[name]


def _asks_parameter(ctx: Context, condition: Expression) -> bool:
    """Whether a parameter decides a condition: other reasons to leave are mostly that all is done, or lost."""
    match condition:
        case Operation(operands=operands):
            return any(_asks_parameter(ctx, one) for one in operands)
        case Name() | Member():
            value = text_of(ctx.value(condition))
            return value is not None and any(hole.parameter for hole in value.holes)
    return False


def _noted(ctx: Context, note: Condition, body: tuple[Statement, ...]) -> None:
    """Follow statements under a condition."""
    ctx.state.under(note, ctx.state.frame.tests.get(note))
    try:
        block(ctx, body)
    finally:
        ctx.state.conditions.pop()


_STATEMENTS: dict[type[Any], Function1[[Any, Any], None]] = {
    Assign: assigned,
    Evaluate: _evaluated,
    Return: _returned,
    Branch: _branched,
    Loop: looped,
    Leave: left,
}
