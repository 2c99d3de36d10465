"""Loops while source is evaluated, over what is known turn by turn, else once for all turns; and the ways out."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Names, Unknown, Value, test_of
from roslens.source.extract.domain.frame import LoopExit, PendingExits
from roslens.source.extract.domain.guarded import Guarded
from roslens.source.extract.domain.kinds import is_number
from roslens.source.extract.domain.unknown_lists import Each, each_of, number_below
from roslens.source.extract.interpreter.in_place import is_augmented
from roslens.source.extract.interpreter.vocabulary_streams import words_read
from roslens.source.extract.ir.program import (
    Assign,
    Branch,
    Expression,
    Leave,
    Literal,
    Loop,
    Member,
    Name,
    Operation,
    Statement,
)
from roslens.source.extract.ir.upward_exposed import is_read_first
from roslens.source.extract.symbolic.condition import ALWAYS, all_of, negated
from roslens.source.extract.symbolic.reason import EachOf
from roslens.source.extract.symbolic.text import Conditions, Text, Written, unknown
from roslens.source.extract.transfer.budget import BudgetExceededError
from roslens.source.extract.transfer.filled_lists import count_of_filled
from roslens.source.extract.transfer.loop_carried import forget_set_by_methods
from roslens.source.extract.transfer.plugin_held import plugged_in

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_RUNS = re.compile(r"ok\(|shutdown", re.IGNORECASE)
"""What the condition of a loop says that goes on as long as the node runs."""
MOST_COUNTED = 16
"""So many turns of a loop that counts are followed one by one."""


def left(ctx: Context, statement: Leave) -> None:
    """Leave a loop, or a turn of it."""
    frame = ctx.state.frame
    if frame.ways is None:
        return
    frame.ways.out.append(LoopExit(tuple(ctx.state.conditions), frame.ways.turn, frame.snapshot(), statement.again))
    frame.stopped = True


def without_ways_out(ctx: Context, since: int) -> None:
    """Note of what follows that no way out was taken of those that were found since."""
    ways = ctx.state.frame.ways
    if ways is None or ctx.state.frame.stopped:
        return
    here = len(ctx.state.conditions)
    for way in ways.out[since:]:
        _hold_not(ctx, way.conditions[here:])


def block_of_loop(ctx: Context, body: tuple[Statement, ...]) -> None:
    """Follow statements of a turn; what comes after them has not taken a way out that is in them."""
    ways = ctx.state.frame.ways
    known = len(ways.out) if ways is not None else 0
    ctx.block(body)
    if ways is not None and len(ways.out) > known:
        without_ways_out(ctx, known)


def _hold_not(ctx: Context, conditions: Conditions) -> None:
    if not conditions:
        return
    note = negated(all_of(conditions))
    if note not in ctx.state.conditions:
        ctx.state.under(note)
        ctx.state.frame.passed += 1


def looped(ctx: Context, statement: Loop) -> None:
    """Follow a loop."""
    frame, depth = ctx.state.frame, len(ctx.state.conditions)
    around, frame.ways = frame.ways, PendingExits(depth)
    broken = None
    try:
        broken = _followed(ctx, statement)
    finally:
        frame.broken = broken
        ways, frame.ways = frame.ways, around
        frame.passed -= len(ctx.state.conditions) - depth
        del ctx.state.conditions[depth:]
        frame.stopped = False
    for way in ways.out:
        if not way.again and len(way.conditions) > way.turn:
            frame.join(way.held, all_of(way.conditions[way.turn :]))


def _followed(ctx: Context, statement: Loop) -> bool | None:
    """Follow the turns of a loop; return whether it was left by ``break``, None where that depends."""
    over = ctx.value(statement.over) if statement.over is not None else None
    target, items = _gone_through(ctx, statement, over)
    if target is not None and items is not None:
        return _each_in_turn(ctx, statement, target, items)
    holds = ctx.truth(over) if statement.over is not None else True
    if statement.target is None and holds is False:
        return False
    if statement.target is None and holds and ctx.budget.repeats:
        _repeated(ctx, statement)
        return None
    count = _count(ctx, statement) if statement.target is None else None
    if count is None or count > MOST_COUNTED:
        _once_for_all(ctx, statement, over)
    else:
        # Until one turn is the last.
        all(_turn(ctx, statement) for _ in range(count))
    return None


def _repeated(ctx: Context, statement: Loop) -> None:
    """Follow a loop with a condition turn by turn, as long as that is known to hold.

    Raises:
        BudgetExceededError: it holds too often.
    """
    for _ in range(ctx.budget.repeats):
        if not _turn(ctx, statement):
            return
        over = ctx.value(statement.over) if statement.over is not None else True
        holds = ctx.truth(over)
        if holds is None:
            _once_for_all(ctx, statement, over)
        if not holds:
            return
    raise BudgetExceededError


def _each_in_turn(ctx: Context, statement: Loop, target: Expression, items: list[Value]) -> bool | None:
    """Follow a turn for each item; return whether one was left by ``break``, None where that depends."""
    frame, depth = ctx.state.frame, len(ctx.state.conditions)
    ways = frame.ways
    for item in items[: ctx.budget.turns]:
        if type(item) is Guarded:
            _perhaps_with(ctx, statement, item)
            continue
        ctx.assign(target, item)
        if not _turn(ctx, statement):
            break
    breaks = [len(way.conditions) > depth for way in ways.out if not way.again] if ways is not None else [True]
    if breaks:
        return None if all(breaks) else True
    return None if len(items) > ctx.budget.turns or any(type(one) is Guarded for one in items) else False


def _once_for_all(ctx: Context, statement: Loop, over: Value) -> None:
    """Follow one turn that stands for all, of which nobody knows how many there are."""
    before, frame = ctx.state.frame.snapshot(), ctx.state.frame
    match statement:
        case Loop(target=None, over=None | Literal()):
            once = True
        case _:
            once = False
    _turn_for_all(ctx, statement, over, once=once)
    if once:
        return
    # It may have no turn at all.
    after, returned = frame.snapshot(), frame.returned
    frame.restore(before)
    frame.returned = False
    if not returned:
        frame.join(after, _written(ctx, statement))
        _keep_filled(frame.names, after[0])


def _turn_for_all(ctx: Context, statement: Loop, over: Value, *, once: bool) -> None:
    """Follow one turn for all that a loop has; where it may have none, what objects hold is the one or the other."""
    changes, frame = ctx.state.store, ctx.state.frame
    since = changes.count
    changes.open += 1
    counted = _counted_to_parameter(ctx, statement)
    _forget_counters(ctx, statement)
    if counted is not None:
        ctx.state.frame.names[counted[0]] = counted[1]
    forget_set_by_methods(ctx, statement)
    if statement.target is not None:
        ctx.assign(statement.target, _each(ctx, over, statement))
    _perhaps_turned(ctx, statement, over, always=counted is not None)
    if changes.count > since and not once:
        way = changes.roll_back(since, frame.members)
        why = (_written(ctx, statement), ALWAYS)
        changes.merge(way, changes.count, frame.members, (False, False), why, None)
    changes.close()


def _perhaps_turned(ctx: Context, statement: Loop, over: Value, *, always: bool) -> None:
    """Follow the one turn that stands for all, under the condition that there is one.

    A node that is up runs its loop; and whoever knows the list that a parameter gives knows what is made of each item.
    """
    written = _written(ctx, statement)
    always = always or statement.over is None or (ctx.truth(over) is True and statement.target is None)
    match over:
        case Each() | Text():
            always = True
    if always or _RUNS.search(written.text):
        _turn(ctx, statement)
        return
    here = len(ctx.state.conditions)
    ctx.state.under(written, test_of(over) if statement.target is None else None)
    _turn(ctx, statement)
    del ctx.state.conditions[here]


def _perhaps_with(ctx: Context, statement: Loop, item: Guarded) -> None:
    """Follow the turn of an item that the list may have."""
    frame, here, before = ctx.state.frame, len(ctx.state.conditions), ctx.state.frame.snapshot()
    changes = ctx.state.store
    since = changes.count
    changes.open += 1
    ctx.state.under(item.condition, item.test)
    if statement.target is not None:
        ctx.assign(statement.target, item.value)
    _turn(ctx, statement)
    del ctx.state.conditions[here]
    after = frame.snapshot()
    returned, frame.returned = frame.returned, False
    frame.restore(before)
    if not returned:
        frame.join(after, item.condition)
    if changes.count > since:
        way = changes.roll_back(since, frame.members)
        why = (item.condition, ALWAYS)
        changes.merge(way, changes.count, frame.members, (False, False), why, item.test)
    changes.close()


def _gone_through(ctx: Context, statement: Loop, over: Value) -> tuple[Expression | None, list[Value] | None]:
    """Return what a loop sets in each turn, and the values in turn; None where they are unknown."""
    target = statement.target
    if target is None:
        return words_read(ctx, statement.over) or (None, None)
    items = ctx.items(over)
    return target, plugged_in(ctx, over) if items is None and ctx.emitter.plugged else items


def _keep_filled(names: Names, after: Names) -> None:
    """Keep what a turn put into lists: what stands for each item of a list is there if any item is."""
    for name, value in after.items():
        kept = names.get(name)
        match value, kept:
            case list(), list(before) if len(value) > len(before):
                names[name] = value


def _written(ctx: Context, statement: Loop) -> Written:
    text = ctx.index.memo.text(statement.over).strip("`") if statement.over is not None else "a loop"
    return Written(text if statement.target is None else f"there is any of {text}")


def _turn(ctx: Context, statement: Loop) -> bool:
    """Follow one turn; return whether another one may follow."""
    frame = ctx.state.frame
    ways = frame.ways
    if ways is None:
        return False
    here, known = len(ctx.state.conditions), len(ways.out)
    ways.turn = here
    ctx.block(statement.body)
    found = ways.out[known:]
    gone, frame.stopped = frame.stopped, False
    if frame.returned:
        return False
    for way in found:
        conditions = way.conditions[here:]
        if way.again and conditions:
            frame.join(way.held, all_of(conditions))
        elif not way.again:
            # There is no turn after one that left the loop.
            _hold_not(ctx, conditions)
    if gone and found and not any(one.again for one in found):
        return False
    ctx.block(statement.update)
    return True


def _count(ctx: Context, statement: Loop) -> int | None:
    """Return how many turns a loop has that counts: ``for (i = 0; i < 3; ++i)``; None where that is unknown."""
    step = _step(statement)
    match statement.over:
        case Operation(operator=operator, operands=(Name() as counter, end)) if step and operator in _STOPS:
            if counter.name != step[0]:
                return None
        case _:
            return None
    first, last = ctx.value(counter), ctx.value(end)
    match last:
        case Unknown():
            last = count_of_filled(ctx, end) or last
    if not (is_number(first) and is_number(last)) or not step[1]:
        return None
    turns = float(last - first) / step[1]
    whole = math.floor(turns) + 1 if operator in ("<=", ">=") else math.ceil(turns)
    return max(0, whole)


def _counted_to_parameter(ctx: Context, statement: Loop) -> tuple[str, Unknown] | None:
    """Return the counter of a loop from 0 up to a parameter, and what stands for each number; None of other loops."""
    step = _step(statement) if statement.target is None else None
    match statement.over:
        case Operation(operator="<" | "!=", operands=(Name(name=name) as counter, end)) if step == (name, 1):
            number = number_below(ctx.value(end)) if ctx.value(counter) == 0 else None
            return None if number is None else (name, number)
    return None


def _step(statement: Loop) -> tuple[str, int | float] | None:
    """Return what counts the turns, and by which step."""
    match statement.update:
        case (Assign(target=Name(name=name), operator="+=", value=Literal(value=by)),) if is_number(by):
            return name, by
        case (
            Assign(
                target=Name(name=name),
                value=Operation(operator="+" | "-" as sign, operands=(Name(name=of), Literal(value=by), *_)),
            ),
        ) if of == name and is_number(by):
            return name, by if sign == "+" else -by
    return None


def _forget_counters(ctx: Context, statement: Loop) -> None:
    """Let be unknown what has another value in each turn: numbers that are set, texts that grow or are read before."""
    frame = ctx.state.frame
    for place, grows in _assigned((*statement.body, *statement.update)):
        match place:
            case Name(name=name) if name in frame.names:
                holder = frame.names
            case Name(name=name) | Member(name=name) if frame.members is not None and name in frame.members:
                holder = frame.members
            case _:
                continue
        before = holder[name]
        match before:
            case bool() | int() | float():
                holder[name] = Unknown(f"{name}, which changes in a loop")
            case Text() if grows:
                holder[name] = unknown(f"{name}, which grows in a loop")
            case Text() if before.known is not None and is_read_first(statement.body, place):
                holder[name] = unknown(f"{name}, which changes in a loop")


def _assigned(body: tuple[Statement, ...]) -> list[tuple[Expression, bool]]:
    """Return what statements assign, and whether the new value is made of the old one."""
    found: list[tuple[Expression, bool]] = []
    waiting: list[Statement] = list(body)
    while waiting:
        one = waiting.pop()
        match one:
            case Assign(value=Operation(operands=operands), declared=""):
                found.append((one.target, is_augmented(one.operator) or one.target in operands))
            case Assign() if one.value is not None and not one.declared:
                found.append((one.target, is_augmented(one.operator)))
            case Branch():
                waiting += [*one.then, *one.otherwise]
            case Loop():
                waiting += [*one.body, *one.update]
    return found


def _each(ctx: Context, over: Value, statement: Loop) -> Value:
    """Return what stands for every item of a list that is unknown; what decides the list decides the item."""
    match over:
        case Each():
            return each_of(over)
        case Text() if over.holes:
            return each_of(over)
    return Unknown(EachOf(ctx.index.memo.text(statement.over)) if statement.over is not None else "an item")


_STOPS = frozenset({"<", "<=", ">", ">=", "!="})
