"""The vocabulary of Python itself: copies, and members that are set by name."""

from __future__ import annotations

from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.domain.abstract_value import Class, Obj, QosValue, Unknown, Value
from roslens.source.extract.domain.quality import quality_of
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.ir.program import Member
from roslens.source.extract.symbolic.text import Text, unknown

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


@outer("copy.copy", "copy.deepcopy", quiet=True)
def copied(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A value that is another one than what it is a copy of."""
    value = called.argument(0)
    if type(value) is list:
        return list(value)
    match value:
        case dict():
            return dict(value)
        case Obj():
            return Obj(value.type, value.defined, dict(value.fields), value.node, value.templates, value.base_templates)
    quality = None if isinstance(value, int) else quality_of(value)
    return value if quality is None or not quality.qos else msgspec.structs.replace(quality)


_PLAIN = (Text, bool, int, float, QosValue)


@outer("setattr", quiet=True)
def member_set(ctx: Context, _thing: Value, called: CallSite) -> None:
    """A member that is set by its name."""
    name = called.argument(1)
    if isinstance(name, Text) and name.known and len(called.written) == 3:
        ctx.assign(Member(called.written[0], name.known), called.argument(2))
    elif len(called.written) == 3 and isinstance(thing := called.argument(0), Obj):
        _forget_members(ctx, thing, name)


def _forget_members(ctx: Context, thing: Obj, name: Value) -> None:
    """Let members be unknown of which one is set and nobody knows which: those whose names fit what is known of it."""
    pattern = name.pattern if isinstance(name, Text) else "*"
    for member, value in list(thing.fields.items()):
        of_values = isinstance(value, list) and all(isinstance(one, _PLAIN) for one in value)
        if (of_values or isinstance(value, _PLAIN)) and fnmatchcase(member, pattern):
            reason = f"{member}, which setattr() may set"
            ctx.state.store.put(thing.fields, member, unknown(reason) if isinstance(value, Text) else Unknown(reason))


@outer("type", quiet=True)
def kind_of(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The class of an object."""
    value = called.argument(0)
    if isinstance(value, Obj) and value.defined is not None and len(called.arguments) == 1:
        return Class(value.defined)
    return Unknown("result of type()")
