"""Lists of C++ that are filled place by place: names of classes that are loaded, and the objects made of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Obj, Table, Unknown, Value
from roslens.source.extract.domain.kinds import all_of_kind, is_whole, table_of
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_HELD = "what it holds"
_EACH = None
"""Key of what stands for each item, where the place is unknown."""


def held_in(thing: Obj) -> Table:
    """Return what is known to be in a list, by its place."""
    return table_of(thing.fields.get(_HELD))


def hold(ctx: Context, thing: Obj, key: Value, value: Value) -> None:
    """Put something at a place of a list; what is only there under a condition of its function is unknown."""
    ctx.summaries.touch()
    place = key if is_whole(key) else _EACH
    match value:
        case Text(holes=()) if place is _EACH:
            value = Unknown("an item of a list")
        case Text() | Obj():
            pass
        case _:
            value = Unknown("an item of a list")
    held = table_of(thing.fields.setdefault(_HELD, {}))
    uncertain = len(ctx.state.conditions) > ctx.state.frame.depth + ctx.state.frame.passed
    if (uncertain or place is _EACH) and held.get(place, value) != value:
        value = Unknown("an item of a list")
    ctx.state.store.put(held, place, value)


def item_held(thing: Obj, key: Value) -> Value:
    """Return what is at a place of a list; None where that is unknown."""
    held = held_in(thing)
    match key:
        case Unknown():
            return held.get(_EACH)
        case int() if _EACH not in held:
            return held.get(key)
    return None


def plugged_in(ctx: Context, value: Value) -> list[Value] | None:
    """Return the plug-ins that a list holds; None where it holds none, or others too."""
    match value:
        case Obj(defined=None):
            held = held_in(value)
        case _:
            return None
    items = [held[key] for key in sorted(all_of_kind(held, int))]
    known = len(items) == len(held) and all(any(one is item for one, _ in ctx.emitter.plugged) for item in items)
    return items if items and known else None
