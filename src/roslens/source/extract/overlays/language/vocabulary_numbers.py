"""Texts that are read as numbers: words of a command line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Unknown, Value
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.symbolic.reason import NumberBelow
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_MOST_SIGNS = 30


@outer("int", "std.stoi", "std.stol", "std.stoul", "atoi", "std.atoi", quiet=True)
def whole(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A text or number is made a whole number."""
    return _number(called, int)


@outer("float", "std.stod", "std.stof", "atof", "std.atof", quiet=True)
def real(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A text or number is made a real number."""
    return _number(called, float)


def _number(called: CallSite, kind: type[int] | type[float]) -> Value:
    if not called.arguments and called.name in ("int", "float"):
        return kind()
    value = called.argument(0)
    match value:
        case Text(known=None):
            # A parameter stays what decides the number.
            return value
        case Unknown(reason=NumberBelow()) if kind is int:
            return value
        case Text(known=str(known)) | (str() | int() | float() as known) if len(called.arguments) == 1:
            if len(str(known)) <= _MOST_SIGNS:
                return _converted(called, known, kind)
    return Unknown(f"result of {called.name}()")


def _converted(called: CallSite, known: str | float, kind: type[int] | type[float]) -> Value:
    try:
        return kind(known)
    except (ValueError, OverflowError):
        return Unknown(f"result of {called.name}()")
