"""Variables that keep their value where a parameter is not set, as ``getParam`` of roscpp leaves them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.domain.abstract_value import Value, as_text
from roslens.source.extract.symbolic.text import And, Condition, Hole, IsSet, Not, Or, Text

if TYPE_CHECKING:
    from roslens.source.extract.domain.frame import Frame


def else_before(value: Value, before: Value) -> Value:
    """Return what a variable is after a parameter was read into it: its value before is a default.

    A value before that is empty, or of which a part is unknown, says nothing of names.
    """
    match value, before:
        case _, bool():
            return value
        case Text(only=Hole(default=None) as hole), (Text() | int() | float()) if hole.parameter:
            earlier = as_text(before).known
            return Text((msgspec.structs.replace(hole, default=earlier),)) if earlier else value
    return value


def forget_defaults(frame: Frame, test: Condition | None) -> None:
    """Let names and members of a function be what they are where a test holds: what is read there is set."""
    there = frozenset(() if test is None else _set(test, holds=True))
    for held in (frame.names, frame.members or {}) if there else ():
        for name, value in held.items():
            match value:
                case Text() if value.holes:
                    held[name] = _without(value, there)


def without_defaults(name: Text, asked: Iterable[tuple[Condition, Condition]]) -> Text:
    """Return a name as it is where these conditions hold: a parameter that is set there has no default."""
    there = frozenset(one for _, test in asked for one in _set(test, holds=True))
    return _without(name, there) if there else name


def _without(name: Text, there: frozenset[str]) -> Text:
    return name.mapped(lambda hole: msgspec.structs.replace(hole, default=None) if hole.parameter in there else hole)


def _set(test: Condition, *, holds: bool) -> Iterator[str]:
    match test:
        case IsSet(text=text) if holds:
            yield from (hole.parameter for hole in text.holes)
        case Not(of=one):
            yield from _set(one, holds=not holds)
        case And(of=parts) if holds:
            yield from (name for one in parts for name in _set(one, holds=holds))
        case Or(of=parts) if not holds:
            yield from (name for one in parts for name in _set(one, holds=holds))
        case _:
            return
