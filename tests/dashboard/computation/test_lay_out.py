"""The picture: the same every time, nothing on top of anything else, namespaces apart."""

from __future__ import annotations

from itertools import combinations

from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.dashboard.computation.lay_out import Item, lay_out

LANES = ("/", "/a", "/a/b", "/c")
MADE = st.integers(0, 14).flatmap(
    lambda count: st.tuples(
        st.lists(
            st.builds(Item, st.floats(20, 200), st.sampled_from((18.0, 26.0)), st.integers(0, 3), st.integers(0, 4)),
            min_size=count,
            max_size=count,
        ),
        st.lists(st.tuples(st.integers(0, max(0, count - 1)), st.integers(0, max(0, count - 1))), max_size=24)
        if count
        else st.just([]),
    )
)


def closed_up(items: list[Item]) -> list[Item]:
    used = sorted({item.column for item in items})
    return [Item(item.width, item.height, item.lane, used.index(item.column)) for item in items]


@settings(max_examples=60)
@given(MADE)
def test_nothing_overlaps(made: tuple[list[Item], list[tuple[int, int]]]) -> None:
    items, wires = closed_up(made[0]), [wire for wire in made[1] if wire[0] != wire[1]]
    picture = lay_out(items, wires, LANES)
    assert picture == lay_out(items, wires, LANES)
    assert len(picture.paths) == len(wires)
    rectangles = [
        (x - item.width / 2, y - item.height / 2, x + item.width / 2, y + item.height / 2)
        for item, (x, y) in zip(items, picture.places, strict=True)
    ]
    for first, second in combinations(rectangles, 2):
        apart = (
            first[2] <= second[0] or second[2] <= first[0] or first[3] <= second[1] + 0.2 or second[3] <= first[1] + 0.2
        )
        assert apart, (first, second)
    assert all(r[0] >= 0 and r[1] >= 0 and r[2] <= picture.width and r[3] <= picture.height for r in rectangles)


@settings(max_examples=60)
@given(MADE)
def test_a_box_holds_its_namespace_and_nothing_else(made: tuple[list[Item], list[tuple[int, int]]]) -> None:
    items, wires = closed_up(made[0]), [wire for wire in made[1] if wire[0] != wire[1]]
    picture = lay_out(items, wires, LANES)
    for box in picture.boxes:
        for item, (x, y) in zip(items, picture.places, strict=True):
            inside = box.x <= x <= box.x + box.width and box.y <= y <= box.y + box.height
            lane = LANES[item.lane]
            if lane == box.name or lane.startswith(box.name + "/"):
                assert inside
            else:
                assert not inside
    for first, second in combinations(picture.boxes, 2):
        if second.name.startswith(first.name + "/"):
            assert first.x < second.x
            assert first.y < second.y
            assert first.x + first.width > second.x + second.width
            assert first.y + first.height > second.y + second.height
        else:
            assert first.y + first.height <= second.y or second.y + second.height <= first.y


def test_an_arrow_is_where_things_flow_to() -> None:
    items = [Item(40, 26, 0, 0), Item(40, 26, 0, 1)]
    there, back = (lay_out(items, [wire], LANES).paths[0] for wire in ((0, 1), (1, 0)))
    left, right = lay_out(items, [(0, 1)], LANES).places
    assert there.endswith(f"L{right[0] - 26:.1f} {right[1] + 3:.1f}")
    assert back.endswith(f"L{left[0] + 26:.1f} {left[1] + 3:.1f}")
