"""A snapshot and what changed since make the next snapshot, whatever changed."""

from __future__ import annotations

from itertools import pairwise

import msgspec
import pytest
from dashboard.live.made_up_snapshots import walk

from roslens.dashboard.live import changes
from roslens.dashboard.live.changes import Change, change, held
from roslens.dashboard.live.snapshot import Item, Link, Picture, Row, Snapshot

_LINK_TOLD = ("state", "rate", "latency", "bandwidth", "age", "lag")


def applied(before: Snapshot, found: Change) -> Snapshot:
    """Return what a page makes of a snapshot and a change, as web/live/changes.js does it."""
    after = msgspec.structs.replace(before, **found.parts)
    keys = [key for key, _ in after.columns]
    rows = {row.key: row for row in before.rows} | {row.key: row for row in found.rows}
    order = [row.key for row in before.rows] if found.order is None else list(found.order)
    for place, *texts in found.cells:
        shown = {key: text for key, text in zip(keys, texts, strict=True) if text is not None}
        rows[order[place]] = msgspec.structs.replace(rows[order[place]], shown=shown)
    items, links = list(after.picture.items), list(after.picture.links)
    for place, state in found.items:
        items[place] = msgspec.structs.replace(items[place], state=state)
    for place, *told in found.links:
        links[place] = msgspec.structs.replace(links[place], **dict(zip(_LINK_TOLD, told, strict=True)))
    picture = msgspec.structs.replace(after.picture, items=tuple(items), links=tuple(links))
    return msgspec.structs.replace(after, rows=tuple(rows[key] for key in order), picture=picture)


@pytest.mark.parametrize("seed", range(60))
def test_a_snapshot_and_what_changed_make_the_next(seed):
    snapshots = walk(seed, 30)
    page = held(snapshots[0])
    for before, after in pairwise(snapshots):
        found = change(before, after)
        assert found is not None
        page = applied(page, found)
        assert page == held(after)


def test_nothing_is_told_of_what_stays():
    snapshot = next(one for one in walk(3, 30) if len(one.rows) > 3 and one.picture.links)
    assert change(snapshot, msgspec.structs.replace(snapshot)) == Change()


def test_a_value_is_told_by_its_place_and_nothing_else():
    row = Row("a", "topic:/a", "/a", "topic", 0, "ok", shown={"rate": "1 Hz"}, values={"rate": 1.0})
    before = Snapshot(
        2, 0.0, "0", "", True, "ok", {}, "", (("rate", "Rate"), ("cpu", "CPU")), (row,), (), Picture(), (), ()
    )
    after = msgspec.structs.replace(
        before, rows=(msgspec.structs.replace(row, shown={"rate": "2 Hz"}, values={"rate": 2.0}),)
    )
    assert change(before, after) == Change(cells=((0, "2 Hz", None),))


def test_two_rows_of_one_key_are_told_whole():
    row = Row("a", "topic:/a", "/a", "topic", 0, "ok")
    before = Snapshot(2, 0.0, "0", "", True, "ok", {}, "", (), (row, row), (), Picture(), (), ())
    assert change(before, before) is None


def test_no_field_is_forgotten():
    """Whatever a row or the picture gets besides is told, too."""
    told = {
        Row: (changes._BESIDES_VALUES, {"key", "counts", "values", "shown"}),
        Item: (changes._PLACE_OF_ITEM, {"state"}),
        Link: (changes._PLACE_OF_LINK, {*_names(changes._OF_LINK)}),
        Picture: (changes._OF_PICTURE, {"items", "links"}),
    }
    for kind, (compared, others) in told.items():
        assert {*_names(compared), *others} == {*kind.__struct_fields__}, kind


def _names(getter):
    return getter.__reduce__()[1]
