"""Lists of which the items are not known while source is evaluated, only what decides them."""

from __future__ import annotations

import msgspec

from roslens.source.extract.domain.abstract_value import Foreign, Unknown, Value, as_text
from roslens.source.extract.domain.kinds import is_whole
from roslens.source.extract.symbolic.reason import EachOf, ItemOf, NumberBelow, OfParameter, PartOf
from roslens.source.extract.symbolic.text import Choice, Hole, Text, unknown
from roslens.source.extract.symbolic.text_lists import is_list, listed


class Each(Foreign, frozen=True):
    """A list of which nobody knows how long it is; ``item`` stands for each of its items."""

    item: Value


def each_of(value: Value) -> Value:
    """Return what stands for every item of a list that is unknown; what decides the list decides the item."""
    match value:
        case Each():
            return value.item
        case Text() if value.holes:
            hole = value.holes[0]
            if hole.choice:
                return Text(
                    (msgspec.structs.replace(hole, reason=EachOf(hole.reason), choice=(_each(hole.choice[0]),)),)
                )
            among = hole.default if is_list(hole) and hole.default else ""
            return Text((Hole(EachOf(hole.reason), hole.parameter, among=among, named=hole.named),))
        case Unknown():
            return Unknown(EachOf(value.reason))
    return Unknown("an item")


def number_below(end: Value) -> Unknown | None:
    """Return what stands for each number that a loop counts from 0 up to a parameter; None for other ends."""
    match end:
        case Text(only=Hole(reason=OfParameter(), choice=(), named=()) as hole) if hole.parameter:
            return Unknown(NumberBelow(hole.reason, hole.default or ""))
    return None


def _each(choice: Choice) -> Choice:
    """Return a choice of items in place of one of lists."""
    then, otherwise = (
        as_text(each_of(one)) if one.holes else unknown(EachOf(str(one))) for one in (choice.then, choice.otherwise)
    )
    return Choice(choice.condition, then, otherwise, choice.test)


def item_of(value: Value, key: Value) -> Value:
    """Return the item at a place of an unknown list; None where it is none that is known to be a list."""
    match value:
        case Each():
            return value.item
        case Text(only=Hole() as hole) if hole.parameter:
            return _item_of_parameter(hole, key)
    return None


def _item_of_parameter(hole: Hole, key: Value) -> Value:
    match key, hole.reason:
        case Unknown(), _:
            return each_of(Text((hole,)))
        case Text(known=str(known)), EachOf() if known:
            # A part of a map in a list that a parameter is: ``plugins[i]["type"]``.
            return Text((Hole(PartOf(known, hole.reason), hole.parameter, named=hole.named),))
    if not is_list(hole) or not is_whole(key):
        return None
    items = listed(hole.default or "")
    usual = items[key] if -len(items) <= key < len(items) else None
    return Text((Hole(ItemOf(key, hole.reason), hole.parameter, usual, named=hole.named),))
