"""The vocabulary of streams of C++ that put texts together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roslens.source.extract.abstract_value import Obj, as_text
from roslens.source.extract.text import Text
from roslens.source.extract.vocabulary import Called, method, outer

if TYPE_CHECKING:
    from roslens.source.extract.evaluation import Evaluation

STREAMS = ("std.stringstream", "std.ostringstream", "stringstream", "ostringstream")
HELD = "-text"


@outer(*STREAMS)
def stream(_engine: Evaluation, _thing: Any, called: Called) -> Any:
    """A stream with a text or without."""
    return Obj("std.stringstream", None, {HELD: as_text(called.argument(0)) if called.arguments else Text()})


@method("std.stringstream", "str")
def text_of(_engine: Evaluation, thing: Any, called: Called) -> Any:
    """The text of a stream is asked for, or given."""
    if called.arguments:
        thing.fields[HELD] = as_text(called.argument(0))
        return None
    return thing.fields[HELD]


@method("std.stringstream", "clear")
def cleared(_engine: Evaluation, _thing: Any, _called: Called) -> Any:
    """The state of a stream is cleared: its text stays."""
    return None


def written_to(thing: Obj, values: list[Any]) -> Obj:
    """Return a stream to which values were written."""
    thing.fields[HELD] = Text.of(thing.fields[HELD], *(as_text(one) for one in values))
    return thing
