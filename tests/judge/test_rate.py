"""Rating: strict bounds, unknown for what is no number."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.ranges.range import Range
from roslens.judge.ranges.rate import rate
from roslens.model.verdict import State


@pytest.mark.parametrize(
    ("value", "range_", "rating"),
    [
        (15, Range(1, 15), State.OK),
        (1, Range(1, 15), State.OK),
        (15.5, Range(1, 15), State.HIGH),
        (0, Range(1, 15), State.LOW),
        (math.inf, Range(maximum=3), State.HIGH),
        (-math.inf, Range(minimum=3), State.LOW),
        (1e9, Range(minimum=3), State.OK),
        (-1e9, Range(maximum=3), State.OK),
        (None, Range(1, 15), State.UNKNOWN),
        (math.nan, Range(1, 15), State.UNKNOWN),
        (math.nan, Range(), State.UNKNOWN),
        (0, Range(), State.OK),
    ],
)
def test_rating(value: float | None, range_: Range, rating: State):
    assert rate(value, range_) is rating


@given(st.floats(allow_nan=False), st.integers(-50, 50), st.integers(0, 50))
def test_ok_is_exactly_what_the_range_holds(value: float, low: int, width: int):
    range_ = Range(low, low + width)
    assert (rate(value, range_) is State.OK) == (value in range_)


def test_ratings_are_words():
    assert {rate(value, Range(1, 2)) for value in (None, 1, 0, 3)} == {State.UNKNOWN, State.OK, State.LOW, State.HIGH}
