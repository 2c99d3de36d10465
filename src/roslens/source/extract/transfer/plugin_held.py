"""Lists of C++ that are filled place by place: names of classes that are loaded, and the objects made of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Obj, Table, Unknown, Value
from roslens.source.extract.domain.kinds import all_of_kind, is_whole
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_HELD = "what it holds"
_EACH = None
"""Key of what stands for each item, where the place is unknown."""


def held_in(thing: Obj) -> Table:
    """Return what is known to be in a list, by its place."""
    found = thing.fields.get(_HELD)
    return found if isinstance(found, dict) else {}


def hold(ctx: Context, thing: Obj, key: Value, value: Value) -> None:
    """Put something at a place of a list; what is only there under a condition of its function is unknown."""
    ctx.summaries.touch()
    place = key if is_whole(key) else _EACH
    if not isinstance(value, Text | Obj) or (place is _EACH and isinstance(value, Text) and not value.holes):
        value = Unknown("an item of a list")
    held = thing.fields.setdefault(_HELD, {})
    if not isinstance(held, dict):
        return
    uncertain = len(ctx.state.conditions) > ctx.state.frame.depth + ctx.state.frame.passed
    if (uncertain or place is _EACH) and held.get(place, value) != value:
        value = Unknown("an item of a list")
    ctx.state.store.put(held, place, value)


def item_held(thing: Obj, key: Value) -> Value:
    """Return what is at a place of a list; None where that is unknown."""
    held = held_in(thing)
    if isinstance(key, Unknown):
        return held.get(_EACH)
    return held.get(key) if _EACH not in held and isinstance(key, int) else None


def plugged_in(ctx: Context, value: Value) -> list[Value] | None:
    """Return the plug-ins that a list holds; None where it holds none, or others too."""
    if not isinstance(value, Obj) or value.defined is not None:
        return None
    held = held_in(value)
    items = [held[key] for key in sorted(all_of_kind(held, int))]
    known = len(items) == len(held) and all(any(one is item for one, _ in ctx.emitter.plugged) for item in items)
    return items if items and known else None
