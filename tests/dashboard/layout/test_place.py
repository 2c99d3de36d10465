"""Heights: as wished where there is room, pushed apart evenly where there is none."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.dashboard.layout.place import settle, spread

WISHES = st.lists(st.tuples(st.floats(-200, 200), st.floats(1, 40)), max_size=12)


def test_wishes_that_fit_are_granted() -> None:
    assert settle([0, 10, 30], [4, 4, 4]) == [0, 10, 30]


def test_two_that_want_the_same_place_share_the_way() -> None:
    assert settle([10, 10], [4, 4]) == pytest.approx([8, 12])


def test_order_wins_over_wishes() -> None:
    assert settle([20, 0], [10, 10]) == pytest.approx([5, 15])


@given(WISHES)
def test_nothing_overlaps_and_the_order_holds(wishes: list[tuple[float, float]]) -> None:
    heights = [height for _, height in wishes]
    places = settle([wish for wish, _ in wishes], heights)
    for number in range(len(places) - 1):
        assert places[number + 1] - places[number] >= (heights[number] + heights[number + 1]) / 2 - 1e-6


def test_a_node_comes_to_stand_between_those_it_needs() -> None:
    centres = spread([[0, 1], [2]], [10, 10, 10], [[], [], [0, 1]], [[2], [2], []])
    assert centres[2] == pytest.approx((centres[0] + centres[1]) / 2)
