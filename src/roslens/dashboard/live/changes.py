"""What changed from one snapshot to the next, for pages that hold the earlier one.

A page holds a snapshot without what it does not show: raw values of rows and the counts of their verdicts.
"""

from __future__ import annotations

from collections.abc import Iterable
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

CellsTold = tuple[int | str | None, ...]
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
    cells: tuple[CellsTold, ...] = ()
    items: tuple[tuple[int, str], ...] = ()
    links: tuple[LinkTold, ...] = ()


def held(snapshot: Snapshot) -> Snapshot:
    """Return a snapshot as a page holds it."""
    return msgspec.structs.replace(snapshot, rows=tuple(map(_held, snapshot.rows)))


def change(before: Snapshot, after: Snapshot) -> Change | None:
    """Return what makes ``after`` of ``before``; None where only all of it can be sent."""
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
    if moved:
        pairs = [(old.get(row.key), place) for place, row in enumerate(after.rows)]
    else:
        pairs = [(before.rows[place], place) for place in changed]
    whole, cells = _rows(pairs, after)
    return Change(parts, order if moved else None, whole, cells, items, links)


def _rows(pairs: Iterable[tuple[Row | None, int]], after: Snapshot) -> tuple[tuple[Row, ...], tuple[CellsTold, ...]]:
    """Return the rows that are sent as a whole, and of others the cells; each pair is what was, and its place now."""
    keys = tuple(key for key, _ in after.columns)
    whole, cells = [], []
    for was, place in pairs:
        row = after.rows[place]
        if was is row:
            continue
        if was is None or _BESIDES_VALUES(was) != _BESIDES_VALUES(row):
            whole.append(_held(row))
        elif was.shown != row.shown:
            cells.append((place, *map(row.shown.get, keys)))
    return tuple(whole), tuple(cells)


def _held(row: Row) -> Row:
    return msgspec.structs.replace(row, values={}, counts={}) if row.values or row.counts else row


def _in_picture(before: Picture, after: Picture) -> tuple[tuple[tuple[int, str], ...], tuple[LinkTold, ...]] | None:
    """Return what changed of what stays in its place; None where something does not."""
    if before is after:
        return (), ()
    same = _OF_PICTURE(before) == _OF_PICTURE(after)
    if not same or len(before.items) != len(after.items) or len(before.links) != len(after.links):
        return None
    items, links = _items(before, after), _links(before, after)
    return None if items is None or links is None else (items, links)


def _items(before: Picture, after: Picture) -> tuple[tuple[int, str], ...] | None:
    found = []
    for place, (was, item) in enumerate(zip(before.items, after.items, strict=True)):
        if was is item:
            continue
        if _PLACE_OF_ITEM(was) != _PLACE_OF_ITEM(item):
            return None
        if was.state != item.state:
            found.append((place, item.state))
    return tuple(found)


def _links(before: Picture, after: Picture) -> tuple[LinkTold, ...] | None:
    found = []
    for place, (was, link) in enumerate(zip(before.links, after.links, strict=True)):
        if was is link:
            continue
        if _PLACE_OF_LINK(was) != _PLACE_OF_LINK(link):
            return None
        if _OF_LINK(was) != _OF_LINK(link):
            found.append((place, *_OF_LINK(link)))
    return tuple(found)
