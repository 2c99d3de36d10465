"""Assignments while source is evaluated: where a value is put, and what that changes besides."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import (
    Class,
    Foreign,
    Named,
    Obj,
    QosValue,
    Remappings,
    Unknown,
    Value,
    as_text,
)
from roslens.source.extract.domain.frame import join
from roslens.source.extract.domain.guarded import Guarded, is_counted
from roslens.source.extract.domain.kinds import fields_of, items_of
from roslens.source.extract.domain.made_texts import with_sign
from roslens.source.extract.domain.quality import changed, quality_of
from roslens.source.extract.domain.summaries import same
from roslens.source.extract.domain.table_key import hashable
from roslens.source.extract.interpreter.in_place import augmented, is_augmented
from roslens.source.extract.ir.program import (
    Assign,
    Call,
    Expression,
    Item,
    Member,
    Name,
    Sequence,
)
from roslens.source.extract.symbolic.text import Text, said, unknown
from roslens.source.extract.symbols.declared_field import declared_field
from roslens.source.extract.transfer.aliases import assign_referred, refer
from roslens.source.extract.transfer.changed_values import forget_where, is_open, put_item
from roslens.source.extract.transfer.class_attributes import set_attribute
from roslens.source.extract.transfer.plugin_held import hold
from roslens.source.extract.transfer.refined_values import refine
from roslens.source.extract.transfer.static_storage import keep, no_place, once, put_where_it_stands
from roslens.source.extract.transfer.xml_rpc_values import XML_RPC, put_part

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def assigned(ctx: Context, statement: Assign) -> None:
    """Follow an assignment or a declaration."""
    operator = statement.operator
    match statement.target:
        case Name(name=name) if operator == "static":
            ctx.state.frame.names[name] = once(ctx, statement)
            return
    if (operator == "&" or operator == "*") and refer(ctx, statement):
        return
    if statement.value is None:
        ctx.state.written_at(statement.line)
        match statement.target:
            case Name() as target:
                of_module = statement.declared == "global"
                value = _set_from_here(ctx, target) if of_module else ctx.objects.declared(statement.declared)
                ctx.state.frame.names[target.name] = value
        return
    value = ctx.value(statement.value)
    if statement.declared:
        value = ctx.objects.converted(statement.declared, value)
    if is_augmented(operator):
        value = augmented(ctx, statement.target, operator, value)
    match statement.target:
        case Name(name=name) if statement.declared:
            ctx.state.frame.names[name] = value
        case _:
            assign(ctx, statement.target, value)


def _set_from_here(ctx: Context, name: Name) -> Value:
    """Return the value of a variable of a module that a function sets; to others it is unknown from now on."""
    key, value = (ctx.state.frame.path, name.name), ctx.value(name)
    reason = f"{name.name}, which {ctx.state.frame.scope.rpartition('.')[2]}() sets"
    match value:
        case Text() if key in ctx.state.constants:
            ctx.state.constants[key] = unknown(reason)
        case bool() | int() | float() if key in ctx.state.constants:
            ctx.state.constants[key] = Unknown(reason)
    return value


def assign(ctx: Context, target: Expression, value: Value) -> None:
    """Put a value where an expression says."""
    match target:
        case Name():
            thing = ctx.state.frame.object
            if target.name not in ctx.state.frame.names and thing is not None and _is_field(ctx, thing, target.name):
                ctx.state.store.put(thing.fields, target.name, value)
            else:
                _assign_name(ctx, target.name, value)
        case Member():
            _assign_member(ctx, target, value)
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


def _assign_member(ctx: Context, target: Member, value: Value) -> None:
    of = ctx.value(target.of)
    match of:
        case Obj():
            ctx.state.store.put(of.fields, target.name, value)
            if of.defined is not None:
                return
        case Class():
            set_attribute(ctx, of, target.name, value)
        case Foreign():
            for one in ctx.expressions.ways_of(of):
                fields = fields_of(one)
                if fields:
                    ctx.state.store.put(fields, target.name, Unknown(f"{target.name} of one of two objects"))
        case QosValue() | Named() if (quality := quality_of(of)) is not None:
            refine(ctx, target.of, of, changed(quality, target.name, value))
    # A member of what is not in the workspace: options that hold callbacks.
    ctx.callbacks.give(value)


def _assign_item(ctx: Context, target: Item, value: Value) -> None:
    of, key = ctx.value(target.of), ctx.value(target.key)
    match of:
        case Remappings():
            if len(ctx.state.conditions) > ctx.state.frame.depth + ctx.state.frame.passed:
                # It may hold, or not: the value of the name is unknown.
                value = unknown(said(as_text(value), f" if {ctx.state.conditions[-1]}"))
            of[hashable(key)] = value
        case dict() if (condition := is_open(ctx)) and hashable(key) not in of:
            forget_where(ctx, of, key)
            of[hashable(key)] = Guarded(value, condition, ctx.state.frame.tests.get(condition))
        case dict() | list():
            put_item(ctx, of, key, value)
        case Text():
            _assign_sign(ctx, target.of, with_sign(of, key, value))
        case Obj() if of.type == "std.vector":
            hold(ctx, of, key, value)
        case Obj() if of.type in XML_RPC:
            put_part(ctx, of, key, value)
        case Foreign():
            for one in ctx.expressions.ways_of(of):
                _put_perhaps(ctx, one, key)


def _put_perhaps(ctx: Context, of: Value, key: Value) -> None:
    """Let an item be unknown of one of several values that may be the one that is changed."""
    match of:
        case dict() | list():
            put_item(ctx, of, key, Unknown("an item of one of two values that is changed"))


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


def _assign_sign(ctx: Context, place: Expression, value: Text) -> None:
    match place:
        case Name() | Member():
            assign(ctx, place, value)
