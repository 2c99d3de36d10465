"""Snapshots in which anything may be another from one to the next."""

from __future__ import annotations

from random import Random

import msgspec

from roslens.dashboard.live.snapshot import Alert, Happening, Item, Link, Picture, Row, Snapshot

COLUMNS = (("rate", "Rate"), ("latency", "Latency"), ("cpu", "CPU"))
STATES = ("ok", "unjudged", "high", "absent")


def walk(seed: int, length: int) -> list[Snapshot]:
    """Return snapshots one after the other; of most only a little changes."""
    draw = Random(seed)
    found = [_any(draw, 0)]
    while len(found) < length:
        found.append(_next(draw, found[-1], len(found)))
    return found


def _any(draw: Random, time: int) -> Snapshot:
    columns = tuple(one for one in COLUMNS if draw.random() < 0.8)
    keys = draw.sample([f"k{number}" for number in range(12)], draw.randrange(9))
    items = tuple(_item(draw, place) for place in range(draw.randrange(5)))
    links = tuple(_link(draw, len(items)) for _ in range(draw.randrange(5) if items else 0))
    return Snapshot(
        version=2, time=time, when=str(time), title="robot", live=draw.random() < 0.9, state=draw.choice(STATES),
        counts={"ok": draw.randrange(4)}, cost="", columns=columns,
        rows=tuple(_row(draw, key, columns) for key in keys),
        alerts=_alerts(draw), picture=Picture(draw.randrange(3), 10.0, 20.0, items, links, draw.choice(["", "2 more"])),
        happened=tuple(Happening(time, "", "is ok", "node:/a", "/a") for _ in range(draw.randrange(2))), failures=(),
        unjudged=draw.randrange(2), muted=_alerts(draw), wrong=draw.randrange(2), follow=draw.randrange(2),
    )  # fmt: skip


def _next(draw: Random, before: Snapshot, time: int) -> Snapshot:
    kind = draw.choice(["nothing", "time", "values", "rows", "order", "states", "picture", "all"])
    made = _any(draw, time)
    if kind == "nothing":
        return msgspec.structs.replace(before)
    if kind == "all":
        return made
    after = msgspec.structs.replace(before, time=float(time), when=str(time), counts=made.counts, muted=made.muted)
    if kind == "values":
        rows = [_row(draw, row.key, before.columns, row) if draw.random() < 0.5 else row for row in before.rows]
        return msgspec.structs.replace(after, rows=tuple(rows))
    if kind == "rows":
        rows = [_row(draw, row.key, before.columns) if draw.random() < 0.5 else row for row in before.rows]
        return msgspec.structs.replace(after, rows=tuple(rows))
    if kind == "order":
        kept = [row for row in before.rows if draw.random() < 0.7]
        come = [row for row in made.rows if all(row.key != other.key for other in kept)]
        rows = draw.sample([*kept, *come], len(kept) + len(come))
        return msgspec.structs.replace(after, rows=tuple(rows), columns=COLUMNS)
    if kind in {"states", "picture"}:
        return msgspec.structs.replace(after, picture=_picture(draw, before.picture, places=kind == "picture"))
    return after


def _picture(draw: Random, before: Picture, *, places: bool) -> Picture:
    items = tuple(msgspec.structs.replace(one, state=draw.choice(STATES)) for one in before.items)
    links = tuple(
        msgspec.structs.replace(one, state=draw.choice(STATES), rate=draw.choice(["", "2 Hz"])) for one in before.links
    )
    if places:
        items = tuple(msgspec.structs.replace(one, x=draw.random()) for one in items)
    return msgspec.structs.replace(before, items=items, links=links)


def _row(draw: Random, key: str, columns: tuple[tuple[str, str], ...], like: Row | None = None) -> Row:
    values = {name: draw.random() for name, _ in columns if draw.random() < 0.7}
    shown = {name: f"{value:.2f}" for name, value in values.items()}
    if like is not None:
        return msgspec.structs.replace(like, values=values, shown=shown)
    counts = {"ok": draw.randrange(3)}
    return Row(
        key, f"topic:/{key}", f"/{key}", "topic", draw.randrange(3), draw.choice(STATES), counts, values, shown,
        draw.choice(["", "inside"]), draw.choice(STATES), draw.choice(["", "1 high below"]),
    )  # fmt: skip


def _alerts(draw: Random) -> tuple[Alert, ...]:
    return tuple(
        Alert(f"a{at}", "node:/a", "/a", "node", "high", "error", "CPU is high", 1.0, "12:00")
        for at in range(draw.randrange(3))
    )


def _item(draw: Random, place: int) -> Item:
    label = draw.choice(["a", "b"])
    return Item(f"node:/{place}", f"/{place}", "node", draw.random(), 0.0, draw.choice(STATES), label, 48.0, 26.0)


def _link(draw: Random, items: int) -> Link:
    return Link(draw.randrange(items), draw.randrange(items), draw.choice(STATES), draw.choice(["", "1 Hz"]),
        age=draw.choice([None, 0.1]), path=draw.choice(["M0 0", "M1 1"]),
    )  # fmt: skip
