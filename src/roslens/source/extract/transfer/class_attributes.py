"""Attributes of classes of Python that code sets: ``Config.topic = "scan"``, ``cls.count = 1``.

Who sets one sets it for all that read it later. What reads it before, or where nobody is seen to set it, does not know
whether it was set meanwhile: another unit of the program may.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.domain.abstract_value import Class, Obj, QosValue, Unknown, Value
from roslens.source.extract.domain.kinds import all_of_kind
from roslens.source.extract.ir.program import Assign, Branch, Call, Expression, Loop, Member, Name
from roslens.source.extract.symbolic.text import Text, unknown

if TYPE_CHECKING:
    from roslens.source.extract.ir.program import Function, Program, Statement
    from roslens.source.extract.symbols.symbol_table import Defined
    from roslens.source.extract.transfer.context import Context

Place = tuple[str, str]


def set_attribute(ctx: Context, of: Class, name: str, value: Value) -> None:
    """Put a value into an attribute of a class."""
    place = _place(ctx, of.defined, name)
    if place is not None:
        before = ctx.expressions.member_of(of, name)
        ctx.summaries.forget_all()
        _for_objects(ctx, of.defined, name, before, value)
        ctx.state.store.put(ctx.state.constants, place, value)


def class_of_scope(ctx: Context) -> Value:
    """Return the class in whose method ``cls`` stands."""
    found = ctx.index.class_of(ctx.state.frame.scope.rpartition(".")[0], ctx.state.frame.path, "")
    return Unknown("cls") if found is None else Class(found)


def read_first(ctx: Context, name: str, value: Value) -> Value:
    """Return the value of an attribute at its first read: that in the class, if nothing sets it by its class."""
    class_name, _, last = name.rpartition(".")
    if (class_name.rpartition(".")[2], last) not in _all_set(ctx):
        return value
    reason = f"{last}, which is set for all of {class_name}"
    match value:
        case QosValue():
            return msgspec.structs.replace(value, unknown=reason)
        case Text():
            return unknown(reason)
        case int() | float():
            return Unknown(reason)
    return value


def of_object(ctx: Context, defined: Defined, name: str, value: Value) -> Value:
    """Return the class attributes of a new object: those in the class, or set for all meanwhile."""
    if (defined.what.name, name) not in _all_set(ctx):
        return value
    return ctx.expressions.member_of(Class(defined), name)


def _for_objects(ctx: Context, defined: Defined, name: str, before: Value, value: Value) -> None:
    """Let objects that are at hand have it too, but for those that have one of their own."""
    frame = ctx.state.frame
    for one in all_of_kind((frame.self, *frame.names.values(), *(frame.members or {}).values()), Obj):
        of_class = one.defined is not None and defined in ctx.index.chain(one.defined)
        if of_class and one.fields.get(name) == before:
            ctx.state.store.put(one.fields, name, value)


def _place(ctx: Context, defined: Defined, name: str) -> Place | None:
    for one in ctx.index.chain(defined):
        constant = ctx.index.member(one, name)
        if constant is not None:
            return constant[0], f"{one.what.qualified_name}.{name}"
    return None


def _all_set(ctx: Context) -> set[Place]:
    """Return the attributes that some function sets on a class, by the last name of that and their own."""
    whole = ctx.index.memo.whole
    if whole.set_on_classes is None:
        whole.set_on_classes = set()
        for program in ctx.index.every_program():
            if program.dialect.modules_run:
                whole.set_on_classes |= set_on_classes(program)
    return whole.set_on_classes


def set_on_classes(program: Program) -> set[Place]:
    """Return the attributes that the code of a file sets on classes, by the last name of that and their own."""
    found: set[Place] = set()
    _gather(program.body, "", found)
    for function in program.functions:
        _gather(function.body, _owner(function), found)
    return found


def _owner(function: Function) -> str:
    return function.class_name.rpartition(".")[2]


def _gather(body: tuple[Statement, ...], owner: str, found: set[Place]) -> None:
    for one in body:
        match one:
            case Assign(target=Member(of=Name(name=of), name=name)) if of != "self":
                found.add((owner if of == "cls" else of.rpartition(".")[2], name))
            case Assign(target=Member(of=of, name=name)) if _is_own_class(of):
                found.add((owner, name))
            case Branch():
                _gather((*one.then, *one.otherwise), owner, found)
            case Loop():
                _gather((*one.body, *one.update), owner, found)


def _is_own_class(of: Expression) -> bool:
    """Whether an expression is ``self.__class__`` or ``type(self)``."""
    match of:
        case Member(name="__class__") | Call(function=Name(name="type"), arguments=(Name(name="self"),)):
            return True
    return False
