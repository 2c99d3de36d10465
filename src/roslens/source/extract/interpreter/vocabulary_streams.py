"""The vocabulary of streams of C++ that put texts together."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Obj, Value, as_text
from roslens.source.extract.domain.kinds import fields_of
from roslens.source.extract.interpreter.vocabulary import CallSite, method, outer
from roslens.source.extract.ir.program import Expression, Operation
from roslens.source.extract.symbolic.text import Hole, Text, unknown
from roslens.source.extract.transfer.plugin_choice import deciding_node

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

STREAMS = ("std.stringstream", "std.ostringstream", "stringstream", "ostringstream")
HELD = "-text"


@outer(*STREAMS)
def stream(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A stream with a text or without."""
    return Obj("std.stringstream", None, {HELD: as_text(called.argument(0)) if called.arguments else Text()})


@method("std.stringstream", "str")
def text_of(_ctx: Context, thing: Obj, called: CallSite) -> Value:
    """The text of a stream is asked for, or given."""
    if called.arguments:
        thing.fields[HELD] = as_text(called.argument(0))
        return None
    return thing.fields[HELD]


@method("std.stringstream", "clear")
def cleared(_ctx: Context, _thing: Value, _called: CallSite) -> Value:
    """The state of a stream is cleared: its text stays."""
    return None


def words_read(ctx: Context, over: Expression | None) -> tuple[Expression, list[Value]] | None:
    """Return what a loop reads the words of a stream into, and these: ``while (stream >> word)``.

    Words of a text that is unknown are one that stands for each. None where a loop does something else.
    """
    match over:
        case Operation(operator=">>", operands=(stream, into)):
            held = fields_of(ctx.value(stream))
        case _:
            return None
    if HELD not in held:
        return None
    text = as_text(held[HELD])
    node = deciding_node(ctx, text)
    if text.holes and text not in node.asks:
        node.asks.append(text)
    usual = text.known if ctx.given.chosen is None else text.usual
    if usual is not None:
        where = f"default of {text.holes[0].reason}" if text.holes else ""
        return into, [Text((Hole(where, default=one),)) if where else Text.of(one) for one in usual.split()]
    decides = next((hole.parameter for hole in text.holes if hole.parameter), "")
    return into, [unknown(f"each word of {text}", parameter=decides)]


def written_to(thing: Obj, values: list[Value]) -> Obj:
    """Return a stream to which values were written."""
    thing.fields[HELD] = Text.of(as_text(thing.fields[HELD]), *(as_text(one) for one in values))
    return thing
