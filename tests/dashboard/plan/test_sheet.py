"""A running system drawn again and again: what stands somewhere stays there, on its own ground or on a given one."""

from __future__ import annotations

from itertools import pairwise

from roslens.dashboard.plan.ground import Part, Wire
from roslens.dashboard.plan.plan import Plan, ground_of
from roslens.dashboard.plan.sheet import Sheet


def robot(count: int, *more: str) -> tuple[list[Part], list[Wire]]:
    """Return a chain of nodes and topics, and further nodes that subscribe to the first topic."""
    keys = [f"{kind}:/{number}" for number in range(count) for kind in ("node", "topic")]
    wires = [*pairwise(keys)] + [("topic:/0", f"node:/{name}") for name in more]
    keys += [f"node:/{name}" for name in more]
    return [Part(key, 80, 26, node=key.startswith("node")) for key in keys], wires


def places(found: Plan, parts: list[Part]) -> dict[str, tuple[float, float]]:
    return dict(zip((part.key for part in parts), found.places, strict=True))


def test_what_is_there_stays_where_it_is_when_something_comes_or_goes() -> None:
    sheet = Sheet()
    parts, wires = robot(4)
    before = places(sheet.of(parts, wires), parts)
    version = sheet.version
    assert places(sheet.of(list(parts), list(wires)), parts) == before
    assert sheet.version == version
    more, joined = robot(4, "new")
    after = places(sheet.of(more, joined), more)
    assert {key: after[key] for key in before} == before
    assert after["node:/new"][0] > before["topic:/0"][0]
    assert sheet.version > version
    again = places(sheet.of(parts, wires), parts)
    assert again == before


def test_where_most_is_new_all_of_it_is_placed_anew() -> None:
    sheet = Sheet()
    sheet.of(*robot(1))
    parts, wires = robot(8)
    assert places(sheet.of(parts, wires), parts) == places(Sheet().of(parts, wires), parts)


def test_on_a_given_ground_everything_stands_where_that_has_it() -> None:
    whole, wires = robot(6)
    ground = ground_of(whole, wires)
    parts, some = robot(3, "unknown")
    found = places(Sheet().of(parts, some, ground), parts)
    for part in parts:
        if part.key in ground.stands:
            assert found[part.key] == (ground.stands[part.key].x, ground.stands[part.key].y)
    assert found["node:/unknown"] not in [(one.x, one.y) for one in ground.stands.values()]


def test_what_comes_and_goes_makes_the_picture_no_wider_for_ever() -> None:
    sheet = Sheet()
    widths = []
    for turn in range(60):
        parts, wires = robot(6)
        wide = Part(f"node:/{turn}", 900.0 + turn, 26)
        widths.append(sheet.of([*parts, wide], [*wires, ("topic:/1", wide.key)]).width)
    assert max(widths[-10:]) <= max(widths[:20])
