"""Texts that are made of other values: ``str(…)``, constructors of ``std::string``, one sign for another one."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Value, as_text
from roslens.source.extract.domain.kinds import known_text
from roslens.source.extract.symbolic.text import Text, said, unknown

_MOST_LENGTH = 10_000
_OF_PYTHON = frozenset({"str", "unicode"})


def text_made(name: str, arguments: list[Value]) -> Text:
    """Return what a constructor or conversion makes: a copy, a part, or so many times one sign."""
    first = arguments[0]
    match first:
        case bool() if name in _OF_PYTHON:
            return Text.of(str(first))
        case float() if name == "std.to_string":
            return Text.of(f"{first:f}")
    if len(arguments) == 1 or name in _OF_PYTHON:
        return as_text(first)
    whole, known = as_text(first), known_text(first)
    second, third = (*arguments[1:3], None)[:2]
    sign = known_text(second)
    if type(first) is int and sign and 0 <= first <= _MOST_LENGTH:
        return Text.of(sign[:1] * first)
    if known is not None and type(second) is int and second >= 0:
        if len(arguments) == 2:
            # Of a literal so many signs are taken; of a std::string the rest from there on.
            return unknown(said("a part of ", whole))
        if type(third) is int:
            return Text.of(known[second:] if third < 0 else known[second : second + third])
    return unknown(said("a part of ", whole), parameter=next((hole.parameter for hole in whole.holes), ""))


def with_sign(of: Text, place: Value, sign: Value) -> Text:
    """Return a text with another sign at a place: ``name[0] = '_'``."""
    known, put = of.known, known_text(sign)
    if known is not None and type(place) is int and 0 <= place < len(known) and put is not None and len(put) == 1:
        return Text.of(known[:place], put, known[place + 1 :])
    parameter = next((hole.parameter for hole in of.holes), "")
    return unknown(said(of, ", with a changed item", most=200), parameter=parameter)
