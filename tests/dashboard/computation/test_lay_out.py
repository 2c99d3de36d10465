"""The picture: the same every time, nothing on top of anything else, namespaces apart."""

from __future__ import annotations

import re
from itertools import combinations

import pytest
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


def drawn(path: str) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
    """Return the points of a wire and of its tip."""
    line, tip = (
        [tuple(map(float, pair.split())) for pair in re.findall(r"-?[\d.]+ -?[\d.]+", re.sub(r"H-?[\d.]+", "", part))]
        for part in re.fullmatch(r"M(.*?)M(.*)", path).groups()  # type: ignore[union-attr]
    )
    return line, tip  # type: ignore[return-value]


@settings(max_examples=100)
@given(MADE)
def test_every_wire_leaves_on_the_right_and_enters_on_the_left(made: tuple[list[Item], list[tuple[int, int]]]) -> None:
    items, wires = closed_up(made[0]), [wire for wire in made[1] if wire[0] != wire[1]]
    picture = lay_out(items, wires, LANES)
    for (source, target), path in zip(wires, picture.paths, strict=True):
        line, tip = drawn(path)
        (x, y), (left, height) = picture.places[source], picture.places[target]
        assert line[0] == pytest.approx((x + items[source].width / 2, y), abs=0.06)
        end = pytest.approx((left - items[target].width / 2, height), abs=0.06)
        assert tip[1] == end
        assert tip[0][0] == tip[2][0] < tip[1][0], "it points to the right, into the element"
        # Right before the tip it comes from outside of the element.
        before = line[-2][0] if len(line) > 4 else line[-3][0]
        assert before <= tip[1][0] + 0.1


def test_a_wire_that_runs_back_turns_round_beside_both_ends() -> None:
    items = [Item(40, 26, 0, 0), Item(60, 26, 0, 1), Item(60, 26, 0, 1), Item(40, 26, 0, 2)]
    picture = lay_out(items, [(0, 1), (1, 3), (3, 0), (2, 3)], LANES)
    (first_x, first_y), (last_x, last_y) = picture.places[0], picture.places[3]
    line, tip = drawn(picture.paths[2])
    assert line[0] == (last_x + 20, last_y)
    assert max(x for x, _ in line) > last_x + 20
    assert min(x for x, _ in line) < first_x - 20
    assert tip[1] == (first_x - 20, first_y)


def test_two_in_one_column_are_joined_from_right_to_left_too() -> None:
    picture = lay_out([Item(40, 26, 0, 0), Item(80, 26, 0, 0)], [(0, 1)], LANES)
    (x, y), (to, height) = picture.places
    line, tip = drawn(picture.paths[0])
    assert line[0] == (x + 20, y)
    assert tip[1] == (to - 40, height)
    assert max(place for place, _ in line) > to + 40
