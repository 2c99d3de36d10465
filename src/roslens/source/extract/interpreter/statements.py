"""Statements while source is evaluated: assignments, branches, loops, and how constructors initialise."""

from __future__ import annotations

from collections.abc import Callable as Function1
from typing import TYPE_CHECKING, Any

from roslens.source.extract.domain.abstract_value import (
    Callable,
    Class,
    Named,
    Names,
    Obj,
    QosValue,
    Remappings,
    Unknown,
    Value,
    as_text,
    test_of,
)
from roslens.source.extract.domain.earlier_values import forget_defaults
from roslens.source.extract.domain.frame import join
from roslens.source.extract.domain.guarded import Guarded, is_counted
from roslens.source.extract.domain.kinds import items_of
from roslens.source.extract.domain.made_texts import with_sign
from roslens.source.extract.domain.owned_pointer import owns_first
from roslens.source.extract.domain.quality import changed, quality_of
from roslens.source.extract.domain.summaries import same
from roslens.source.extract.domain.table_key import hashable
from roslens.source.extract.interpreter.loops import block_of_loop, left, looped, without_ways_out
from roslens.source.extract.interpreter.objects import is_list
from roslens.source.extract.ir.program import (
    NO_BREAK,
    Assign,
    Branch,
    Call,
    Evaluate,
    Expression,
    Item,
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
from roslens.source.extract.symbolic.text import Condition, NoException, Text, said, unknown
from roslens.source.extract.symbols.declared_field import declared_field
from roslens.source.extract.symbols.symbol_table import type_arguments, type_name
from roslens.source.extract.transfer.aliases import assign_referred, refer
from roslens.source.extract.transfer.changed_values import is_open, put_item
from roslens.source.extract.transfer.class_attributes import set_attribute
from roslens.source.extract.transfer.plugin_held import hold
from roslens.source.extract.transfer.refined_values import refine
from roslens.source.extract.transfer.static_storage import keep, no_place, once, put_where_it_stands, returned
from roslens.source.extract.transfer.xml_rpc_values import XML_RPC, put_part

if TYPE_CHECKING:
    from roslens.source.extract.domain.frame import Held
    from roslens.source.extract.transfer.context import Context


def initialise(ctx: Context, statement: Statement) -> None:
    """Evaluate an initialiser of a constructor: of a member, or of a base."""
    match statement:
        case Evaluate(expression=Call() as call):
            arguments = [ctx.value(one) for one in call.arguments]
            ctx.state.at(call)
            _initialise_base(ctx, call, arguments, {})
        case Assign(target=Member(name=name)) if statement.value is not None:
            thing = ctx.state.frame.self
            declared = declared_field(ctx.index, thing.defined, name) if isinstance(thing, Obj) else ""
            value = ctx.value(statement.value)
            ctx.state.written_at(statement.line)
            if isinstance(statement.value, Sequence):
                kind, inside = type_name(declared)
                items = items_of(value)
                if "ptr" in declared.lower() and owns_first(items):
                    value = items[0]
                elif not is_list(declared):
                    value = ctx.objects.of_type(kind, list(items), {}, tuple(type_arguments(inside)))
                elif items and isinstance(items[0], int | float) and inside.endswith("string"):
                    value = Unknown(f"{name}, which is so many texts")
            elif declared:
                value = ctx.objects.constructed(declared, value)
            if isinstance(thing, Obj):
                thing.fields[name] = value


def _initialise_base(ctx: Context, call: Call, arguments: list[Value], keywords: Names) -> None:
    """Construct a base, or delegate to another constructor of the class."""
    thing = ctx.state.frame.self
    if not isinstance(call.function, Name) or not isinstance(thing, Obj):
        return
    written = call.function.name
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


def _assigned(ctx: Context, statement: Assign) -> None:
    if statement.operator == "static" and isinstance(statement.target, Name):
        ctx.state.frame.names[statement.target.name] = once(ctx, statement)
        return
    if statement.operator in _REFERRING and refer(ctx, statement):
        return
    if statement.value is None:
        ctx.state.written_at(statement.line)
        if isinstance(statement.target, Name):
            of_module = statement.declared == "global"
            value = _set_from_here(ctx, statement.target) if of_module else ctx.objects.declared(statement.declared)
            ctx.state.frame.names[statement.target.name] = value
        return
    value = ctx.value(statement.value)
    if statement.declared:
        value = ctx.objects.converted(statement.declared, value)
    if statement.operator == "+=":
        value = ctx.expressions.sum(ctx.value(statement.target), value)
    if statement.declared and isinstance(statement.target, Name):
        ctx.state.frame.names[statement.target.name] = value
    else:
        assign(ctx, statement.target, value)


def _set_from_here(ctx: Context, name: Name) -> Value:
    """Return the value of a variable of a module that a function sets; to others it is unknown from now on."""
    key, value = (ctx.state.frame.path, name.name), ctx.value(name)
    if key in ctx.state.constants and isinstance(value, _PLAIN):
        reason = f"{name.name}, which {ctx.state.frame.scope.rpartition('.')[2]}() sets"
        ctx.state.constants[key] = unknown(reason) if isinstance(value, Text) else Unknown(reason)
    return value


def assign(ctx: Context, target: Expression, value: Value) -> None:
    """Put a value where an expression says."""
    match target:
        case Name():
            thing = ctx.state.frame.self
            if (
                target.name not in ctx.state.frame.names
                and isinstance(thing, Obj)
                and _is_field(ctx, thing, target.name)
            ):
                ctx.state.store.put(thing.fields, target.name, value)
            else:
                _assign_name(ctx, target.name, value)
        case Member():
            of = ctx.value(target.of)
            match of:
                case Obj():
                    ctx.state.store.put(of.fields, target.name, value)
                case Class():
                    set_attribute(ctx, of, target.name, value)
                case QosValue() | Named() if (quality := quality_of(of)) is not None:
                    refine(ctx, target.of, of, changed(quality, target.name, value))
            if isinstance(value, Callable) and (not isinstance(of, Obj) or of.defined is None):
                # A member of what is not in the workspace: options that hold callbacks.
                ctx.callbacks.give(value)
        case Call():
            no_place(ctx)
            put_where_it_stands(ctx, ctx.value(target), value)
        case Item():
            _assign_item(ctx, target, value)
        case Sequence():
            parts = items_of(value)
            known = len(parts) == len(target.items) and is_counted(parts)
            for place, one in enumerate(target.items):
                assign(ctx, one, parts[place] if known else Unknown("a part of an unknown value"))


def _assign_item(ctx: Context, target: Item, value: Value) -> None:
    of, key = ctx.value(target.of), ctx.value(target.key)
    if isinstance(of, Remappings) and len(ctx.state.conditions) > ctx.state.frame.depth + ctx.state.frame.passed:
        # It may hold, or not: nobody knows what the name becomes.
        value = unknown(said(as_text(value), f" if {ctx.state.conditions[-1]}"))
    match of:
        case Remappings():
            of[hashable(key)] = value
        case dict() if (condition := is_open(ctx)) and hashable(key) not in of:
            of[hashable(key)] = Guarded(value, condition, ctx.state.frame.tests.get(condition))
        case dict() | list():
            put_item(ctx, of, key, value)
        case Text() if isinstance(target.of, Name | Member):
            assign(ctx, target.of, with_sign(of, key, value))
        case Obj() if of.type == "std.vector":
            hold(ctx, of, key, value)
        case Obj() if of.type in XML_RPC:
            put_part(ctx, of, key, value)


def _assign_name(ctx: Context, name: str, value: Value) -> None:
    frame = ctx.state.frame
    if name in frame.kept:
        keep(ctx, name, value)
        return
    if name in frame.aliases and name not in frame.names:
        assign_referred(ctx, name, value)
        return
    whole = "" if name in frame.names else ctx.index.global_name(name, frame.path, frame.scope)
    if not whole:
        frame.names[name] = value
        return
    before = ctx.state.globals.get(whole)
    if len(ctx.state.conditions) > frame.passed:
        ctx.state.globals.setdefault(whole, ctx.value(Name(name)))
        join(ctx.state.globals, {whole: value}, ctx.state.conditions[-1])
    else:
        ctx.state.globals[whole] = value
    if before is None or not same(before, ctx.state.globals[whole]):
        ctx.summaries.forget_all()


def _is_field(ctx: Context, thing: Obj, name: str) -> bool:
    if ctx.state.frame.path in ctx.index.programs and not ctx.dialect.members_without_object:
        return False
    return name in thing.fields or bool(declared_field(ctx.index, thing.defined, name)) or name.endswith("_")


def _evaluated(ctx: Context, statement: Evaluate) -> None:
    ctx.value(statement.expression)
    called = statement.expression.function if isinstance(statement.expression, Call) else None
    if called == Name("throw") and len(ctx.state.conditions) > ctx.state.frame.depth + ctx.state.frame.passed:
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
    if holds is not None:
        follow = block if ctx.state.frame.ways is None else block_of_loop
        follow(ctx, statement.then if holds else statement.otherwise)
        return
    written, frame = ctx.index.memo.condition(statement.condition), ctx.state.frame
    before, ways = frame.snapshot(), len(frame.ways.out) if frame.ways else 0
    otherwise, changes = negated(written), ctx.state.store
    since = changes.count
    changes.open += 1
    frame.know(written, otherwise, test_of(decides))
    if type(written) is NoException:
        block(ctx, statement.then)
    else:
        _noted(ctx, written, statement.then)
    returned, gone, plainly = frame.returned, frame.returned or frame.stopped, frame.plainly
    after = before if frame.is_as(before) else frame.snapshot()
    frame.restore(before)
    second = changes.count
    way = changes.roll_back(since, frame.members) if second > since else {}
    frame.returned = frame.stopped = False
    if statement.otherwise and type(written) is NoException and after is not before:
        _handled(ctx, statement, (before, after), (written, otherwise))
    elif statement.otherwise:
        _noted(ctx, otherwise, statement.otherwise)
    other_returned, other_gone = frame.returned, frame.returned or frame.stopped
    if way or changes.count > second:
        test = frame.tests.get(written)
        changes.merge(way, second, frame.members, (gone, other_gone), (written, otherwise), test)
    changes.open -= 1
    if not changes.open and changes.count:
        changes.ended()
    if returned is not other_returned and (after is not before or other_returned):
        frame.leave(after[1] if returned else dict(frame.members or {}), before[1], written if returned else otherwise)
    # A way that leaves the function, or the loop, has no say in what holds after it.
    if other_gone and not gone:
        frame.restore(after)
    elif other_gone is gone and (after is not before or statement.otherwise):
        frame.join(after, written)
    frame.returned = returned and other_returned
    frame.stopped = gone and other_gone and not frame.returned
    if gone is not other_gone and ctx.emitter.node.generation == "ros1":
        forget_defaults(frame, frame.tests.get(otherwise if gone else written))
    if returned and not other_gone and plainly and _asks_parameter(ctx, statement.condition):
        # What follows is reached only where the function was not left.
        ctx.state.under(otherwise, frame.tests.get(otherwise))
        frame.passed += 1
    without_ways_out(ctx, ways)


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
    if isinstance(condition, Operation):
        return any(_asks_parameter(ctx, one) for one in condition.operands)
    value = ctx.value(condition) if isinstance(condition, Name | Member) else None
    return isinstance(value, Text) and any(hole.parameter for hole in value.holes)


def _noted(ctx: Context, note: Condition, body: tuple[Statement, ...]) -> None:
    """Follow statements under a condition."""
    ctx.state.under(note, ctx.state.frame.tests.get(note))
    try:
        block(ctx, body)
    finally:
        ctx.state.conditions.pop()


_REFERRING = ("&", "*")
_PLAIN = (Text, bool, int, float)
_STATEMENTS: dict[type[Any], Function1[[Any, Any], None]] = {
    Assign: _assigned,
    Evaluate: _evaluated,
    Return: _returned,
    Branch: _branched,
    Loop: looped,
    Leave: left,
}
