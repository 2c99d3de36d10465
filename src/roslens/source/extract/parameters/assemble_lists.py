"""Texts with holes that stand for the items of a list which a parameter is: one text for each item."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import msgspec

from roslens.source.extract.symbolic.reason import (
    FIRST,
    EachOf,
    ItemOf,
    NumberBelow,
    OfParameter,
    Reason,
)
from roslens.source.extract.symbolic.text import Hole, Text
from roslens.source.extract.symbolic.text_lists import listed

Items = Callable[[Hole], "list[str | Hole] | None"]
"""Returns the items that a hole stands for; None where it stands for none, or they are unknown."""
_DEEPEST = 4
_MOST_NUMBERS = 64


def each_of(texts: tuple[Text, ...], items: Items) -> tuple[tuple[Text, ...], ...]:
    """Return these texts once for each item of the first list in them, with the item in all its places.

    What the item names may be a list as well; lists that have nothing to do with each other are left as they are: they
    may be gone through side by side, and not each with each.
    """
    return tuple(_each(texts, items, frozenset(), 0))


def _each(texts: tuple[Text, ...], items: Items, others: frozenset[Hole], depth: int) -> Iterator[tuple[Text, ...]]:
    holes = [one for text in texts for one in _holes(text)] if depth < _DEEPEST else []
    for hole in holes:
        found = None if hole in others else items(hole)
        if found is not None:
            for one in found or [Hole(f"{hole.reason}, which is empty")]:
                filled = tuple(_with(text, hole, one) for text in texts)
                yield from _each(filled, items, others | frozenset(holes), depth + 1)
            return
    yield texts


def _holes(text: Text) -> Iterator[Hole]:
    for hole in text.holes:
        for one in hole.named:
            yield from _holes(one)
        yield hole


def _with(text: Text, hole: Hole, item: str | Hole) -> Text:
    if not text.holes:
        return text
    return text.with_holes(lambda part: item if part == hole else _renamed(part, hole, item))


def _renamed(part: Hole, hole: Hole, item: str | Hole) -> Hole:
    """Return a hole of a parameter whose name has an item in it."""
    named = tuple(_with(one, hole, item) for one in part.named)
    if named == part.named:
        return part
    name = named[0].usual
    if name is None:
        return msgspec.structs.replace(part, named=named)
    reason = _of_parameter(part.reason, name)
    match reason, named:
        case OfParameter(), (_, of_default, *_):
            default = of_default.usual
        case _:
            default = part.default
    return Hole(reason, name, default, part.below, among=part.among)


def _of_parameter(reason: Reason, name: str) -> Reason:
    """Return the reason of the parameter of a name, or of items of it as the reason has them."""
    match reason:
        case EachOf(of=of):
            return EachOf(_of_parameter(of, name))
        case ItemOf(place=place, of=of):
            return ItemOf(place, _of_parameter(of, name))
        case NumberBelow(of=of):
            return NumberBelow(_of_parameter(of, name))
    return OfParameter(name)


def _is_own_list(hole: Hole) -> bool:
    """Return whether it is a list that a parameter of this node gives, each of its items or one of them.

    Of what else is made of a list nobody knows what it is, and of which parameter where a part of its name is unknown.
    """
    match hole.reason:
        case OfParameter(node=node) | EachOf(of=OfParameter(node=node)) | ItemOf(of=OfParameter(node=node)):
            return node == FIRST and not hole.named
    return False


def parameter_of(hole: Hole) -> str:
    """Return the parameter that decides which items a hole stands for; empty where none of this node does."""
    match hole.reason:
        case NumberBelow(of=OfParameter(name=name, node=node)):
            return name if node == FIRST else ""
    return hole.parameter


def _numbers(below: str | None) -> list[str] | None:
    """Return the numbers that a loop counts; None where it is unknown how many, or they are too many."""
    count = int(below) if below is not None and below.isdecimal() else None
    return None if count is None or count > _MOST_NUMBERS else [str(one) for one in range(count)]


def items_among(hole: Hole, value: Text | None) -> list[str] | None:
    """Return the items that a hole stands for where its parameter is set to a value, or to none; None where unknown."""
    match hole.reason:
        case NumberBelow(default=default):
            return _numbers(default if value is None else value.known)
    if not _is_own_list(hole):
        return None
    known = (hole.among or hole.default) if value is None else value.known
    if known is None or not (known.startswith("[") and known.endswith("]")):
        return None
    names = listed(known)
    match hole.reason:
        case ItemOf(place=place):
            return [names[place]] if -len(names) <= place < len(names) else []
    return names
