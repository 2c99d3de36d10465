"""One text for two of which a condition chooses, as short as what is known of both allows."""

from __future__ import annotations

import msgspec

from roslens.source.extract.domain.plain_methods import is_namespace
from roslens.source.extract.symbolic.reason import NamePart, OfController, OfHandle, OfNode, Reason
from roslens.source.extract.symbolic.text import (
    Choice,
    Condition,
    Hole,
    NoException,
    Text,
)
from roslens.source.extract.symbolic.widening import of_many

_LONG = 400
"""So much of the words for a choice is kept; one of few texts has fewer."""


def _but_for_slashes(one: Text, other: Text) -> Text | None:
    """Return the text with more separators where texts differ by one after a namespace only.

    A namespace ends with ``/`` only where it is nothing else; a name with two of them is tidied.
    """
    if not any(is_namespace(hole) for hole in one.holes):
        return None
    most = max(one, other, key=lambda text: len(text.pattern))
    least = other if most is one else one
    for place in range(len(most.parts) - 1):
        match most.parts[place : place + 2]:
            case (part, str(rest)) if is_namespace(part) and rest.startswith("/"):
                without = Text.of(*most.parts[: place + 1], rest[1:], *most.parts[place + 2 :])
                if without == least or Text.of("/", without) == least:
                    return most
    return None


def _below(one: Text, other: Text, condition: Condition) -> Text | None:
    """Return a name that is below a namespace where it is relative: ``topic[0] != '/' ? ns + "/" + topic : topic``."""
    match one.parts, other.parts:
        case (Hole(reason=above), "/", Hole() as last), (Hole() as name,) if name == last:
            possible = _may_be_namespace(above) and "/" in str(condition)
            return Text((msgspec.structs.replace(name, below=above),)) if possible else None
    return None


def _may_be_namespace(reason: Reason) -> bool:
    match reason:
        case OfNode(what=what):
            return what in (NamePart.NAMESPACE, NamePart.ABOVE)
        case OfHandle() | OfController():
            return True
    return False


def _deciding(text: Text) -> list[str]:
    return [hole.parameter or str(hole.reason) for hole in text.holes]


def _both(one: Text, other: Text, condition: Condition) -> Text | None:
    """Return one text that stands for either of two; None where they differ."""
    if one.pattern == other.pattern and _deciding(one) == _deciding(other) and not _chooses(one, other):
        return min(one, other, key=lambda text: len(str(text)))
    same = _but_for_slashes(one, other)
    return same if same is not None else _below(one, other, condition) or _below(other, one, condition)


def either(one: Text, other: Text, condition: Condition, test: Condition | None = None) -> Text:
    """Return the text that is one where a condition holds, and the other one where it does not."""
    if one == other:
        return one
    if type(condition) is NoException and not (one.parts and other.parts):
        return one if one.parts else other
    both = _both(one, other, condition) if one.parts and other.parts else None
    if both is not None:
        return both
    shown = [str(text) if text.parts else "nothing" for text in (one, other)]
    reason = f"{shown[0]} if {str(condition)[:60]}, else {shown[1]}"
    many = of_many(condition, one, other) if len(reason) > _LONG else None
    if many is not None:
        return many
    parameter = next((hole.parameter for hole in (*one.holes, *other.holes) if hole.parameter), "")
    choice = Choice(condition, one, other, () if test is None else (test,))
    return Text((Hole(reason[:_LONG], parameter, choice=(choice,)),))


def _chooses(*texts: Text) -> bool:
    return any(hole.choice for text in texts for hole in text.holes)
