"""The vocabulary of Python itself: copies, and members that are set by name."""

from __future__ import annotations

from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Class, Obj, QosValue, Unknown, Value
from roslens.source.extract.domain.kinds import known_text, text_of
from roslens.source.extract.interpreter.copied_values import copied, deep_copied
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.ir.program import Member
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.symbols.symbol_table import Defined

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


@outer("copy.copy", quiet=True)
def copy_of(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A value that is another one than what it is a copy of."""
    return copied(ctx, called.argument(0))


@outer("copy.deepcopy", quiet=True)
def deep_copy_of(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A value that is another one than what it is a copy of, with all that it holds."""
    return deep_copied(ctx, called.argument(0))


@outer("setattr", quiet=True)
def member_set(ctx: Context, _thing: Value, called: CallSite) -> None:
    """A member that is set by its name."""
    if len(called.written) != 3:
        return
    name, thing = called.argument(1), called.given(Obj, 0)
    known = known_text(name)
    if known:
        ctx.assign(Member(called.written[0], known), called.argument(2))
    elif thing is not None:
        _forget_members(ctx, thing, name)


def _forget_members(ctx: Context, thing: Obj, name: Value) -> None:
    """Let members be unknown of which an unknown one is set: those whose names fit what is known of it."""
    text = text_of(name)
    pattern = "*" if text is None else text.pattern
    for member, value in [item for item in thing.fields.items() if fnmatchcase(item[0], pattern)]:
        reason = f"{member}, which setattr() may set"
        match value:
            case Text():
                ctx.state.store.put(thing.fields, member, unknown(reason))
            case bool() | int() | float() | QosValue():
                ctx.state.store.put(thing.fields, member, Unknown(reason))
            case list() if all(map(_is_plain, value)):
                ctx.state.store.put(thing.fields, member, Unknown(reason))


def _is_plain(value: Value) -> bool:
    match value:
        case Text() | bool() | int() | float() | QosValue():
            return True
    return False


@outer("type", quiet=True)
def kind_of(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The class of an object."""
    match called.arguments:
        case [Obj(defined=Defined() as defined)]:
            return Class(defined)
    return Unknown("result of type()")
