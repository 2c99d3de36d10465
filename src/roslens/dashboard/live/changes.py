"""What changed from one snapshot to the next, for pages that hold the earlier one.

A page holds a snapshot without what it does not show: raw values of rows and the counts of their verdicts.
"""

from __future__ import annotations

from operator import attrgetter
from typing import Any

import msgspec

from roslens.dashboard.live.snapshot import Picture, Row, Snapshot
from roslens.dashboard.live.stirred import stirred

_LARGE = ("rows", "picture")
_WHOLE = tuple(name for name in Snapshot.__struct_fields__ if name not in _LARGE)
_KEY = attrgetter("key")
_BESIDES_VALUES = attrgetter("entity", "name", "kind", "depth", "state", "observer", "worst", "below")
_PLACE_OF_ITEM = attrgetter("entity", "name", "kind", "x", "y", "label", "w", "h")
_PLACE_OF_LINK = attrgetter("start", "end", "path", "by", "word")
_OF_LINK = attrgetter("state", "rate", "latency", "bandwidth", "age", "lag")
_OF_PICTURE = attrgetter("version", "width", "height", "left_out", "boxes", "as_lines")

LinkTold = tuple[int, str, str, str, str, float | None, float | None]


class Change(msgspec.Struct, frozen=True, omit_defaults=True):
    """What makes a later snapshot of an earlier one.

    Attributes:
        parts: fields that are others now, whole; the picture is among them where a place in it is another.
        order: keys of all rows, where rows came, went or moved.
        rows: those that came, or of which more than the values changed, whole.
        cells: of the others that changed, the place in the order and the value in each column; None where it has none.
        items: place in the picture and state of what has another one.
        links: place in the picture, state, rate, latency, bandwidth, age and lag of lines that have others.
    """

    parts: dict[str, Any] = {}
    order: tuple[str, ...] | None = None
    rows: tuple[Row, ...] = ()
    cells: tuple[tuple[int | str | None, ...], ...] = ()
    items: tuple[tuple[int, str], ...] = ()
    links: tuple[LinkTold, ...] = ()


def held(snapshot: Snapshot) -> Snapshot:
    """Return a snapshot as a page holds it."""
    return msgspec.structs.replace(snapshot, rows=tuple(map(_held, snapshot.rows)))


def change(before: Snapshot, after: Snapshot) -> Change | None:
    """Return what makes ``after`` of ``before``; None where only all of it can be told."""
    changed = stirred(before.rows, after.rows)
    moved = len(before.rows) != len(after.rows) or any(_KEY(before.rows[at]) != _KEY(after.rows[at]) for at in changed)
    order = tuple(map(_KEY, after.rows))
    old = {row.key: row for row in before.rows} if moved else {}
    if len(set(order)) != len(order) or (moved and len(old) != len(before.rows)):
        return None
    parts = {name: getattr(after, name) for name in _WHOLE if getattr(after, name) != getattr(before, name)}
    drawn = _in_picture(before.picture, after.picture)
    if drawn is None:
        parts["picture"] = after.picture
    items, links = drawn or ((), ())
    keys = tuple(key for key, _ in after.columns)
    whole, cells = [], []
    for place in range(len(after.rows)) if moved else changed:
        row = after.rows[place]
        was = old.get(row.key) if moved else before.rows[place]
        if was is row:
            continue
        if was is None or _BESIDES_VALUES(was) != _BESIDES_VALUES(row):
            whole.append(_held(row))
        elif was.shown != row.shown:
            cells.append((place, *map(row.shown.get, keys)))
    return Change(parts, order if moved else None, tuple(whole), tuple(cells), items, links)


def _held(row: Row) -> Row:
    return msgspec.structs.replace(row, values={}, counts={}) if row.values or row.counts else row


def _in_picture(before: Picture, after: Picture) -> tuple[tuple[tuple[int, str], ...], tuple[LinkTold, ...]] | None:
    """Return what changed of what stays in its place; None where something does not."""
    if before is after:
        return (), ()
    same = _OF_PICTURE(before) == _OF_PICTURE(after)
    if not same or len(before.items) != len(after.items) or len(before.links) != len(after.links):
        return None
    items, links = [], []
    for place, (was_item, item) in enumerate(zip(before.items, after.items, strict=True)):
        if was_item is item:
            continue
        if _PLACE_OF_ITEM(was_item) != _PLACE_OF_ITEM(item):
            return None
        if was_item.state != item.state:
            items.append((place, item.state))
    for place, (was_link, link) in enumerate(zip(before.links, after.links, strict=True)):
        if was_link is link:
            continue
        if _PLACE_OF_LINK(was_link) != _PLACE_OF_LINK(link):
            return None
        if _OF_LINK(was_link) != _OF_LINK(link):
            links.append((place, *_OF_LINK(link)))
    return tuple(items), tuple(links)
