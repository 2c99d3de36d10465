"""Rating: strict bounds, unknown for what is no number."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.ranges.range import Range
from roslens.judge.ranges.rate import Rating, rate


@pytest.mark.parametrize(
    ("value", "range_", "rating"),
    [
        (15, Range(1, 15), Rating.OK),
        (1, Range(1, 15), Rating.OK),
        (15.5, Range(1, 15), Rating.HIGH),
        (0, Range(1, 15), Rating.LOW),
        (math.inf, Range(maximum=3), Rating.HIGH),
        (-math.inf, Range(minimum=3), Rating.LOW),
        (1e9, Range(minimum=3), Rating.OK),
        (-1e9, Range(maximum=3), Rating.OK),
        (None, Range(1, 15), Rating.UNKNOWN),
        (math.nan, Range(1, 15), Rating.UNKNOWN),
        (math.nan, Range(), Rating.UNKNOWN),
        (0, Range(), Rating.OK),
    ],
)
def test_rating(value: float | None, range_: Range, rating: Rating):
    assert rate(value, range_) is rating


@given(st.floats(allow_nan=False), st.integers(-50, 50), st.integers(0, 50))
def test_ok_is_exactly_what_the_range_holds(value: float, low: int, width: int):
    range_ = Range(low, low + width)
    assert (rate(value, range_) is Rating.OK) == (value in range_)


def test_ratings_are_words():
    assert [rating.value for rating in Rating] == ["unknown", "ok", "low", "high"]
