"""Bars that hold every value once, with places for the bounds of models."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.dashboard.charts.histogram import MOST_BARS, figures_of, histogram_of

VALUES = st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=60) | st.lists(
    st.integers(0, 400).map(float), min_size=1, max_size=60
)


def test_small_whole_numbers_get_a_bar_each() -> None:
    found = histogram_of([1.0, 1.0, 2.0, 4.0])
    assert found is not None
    assert [(bar.label, bar.count) for bar in found.bars] == [("1", 2), ("2", 1), ("3", 0), ("4", 1)]
    assert not found.tail


def test_a_long_tail_becomes_one_bar() -> None:
    found = histogram_of([float(number % 10) for number in range(1000)] + [5000.0])
    assert found is not None
    assert found.tail
    assert len(found.bars) == 11
    assert found.bars[-1].count == 1
    assert found.bars[-1].label == "10 to 5,000"


def test_bounds_stand_at_the_ends_of_bars() -> None:
    found = histogram_of([1.0, 2.0, 3.0, 4.0])
    assert found is not None
    assert found.position(1) == 0
    assert found.position(3) == pytest.approx(0.5)
    assert found.position(5) == 1
    assert found.position(99) == 1


@given(VALUES)
def test_every_value_is_in_one_bar(values: list[float]) -> None:
    found = histogram_of(values, 1)
    assert found is not None
    assert sum(bar.count for bar in found.bars) == len(values)
    assert len(found.bars) <= MOST_BARS + 2
    assert found.bars[0].low <= min(values) + 1e-6
    for value in values:
        assert 0 <= found.position(value) <= 1


def test_figures_are_those_of_the_sample() -> None:
    found = figures_of([4.0, 1.0, 1.0, 2.0])
    assert found is not None
    assert (found.n, found.least, found.median, found.mean, found.most) == (4, 1, 1.5, 2, 4)
    assert found.deviation == pytest.approx(2**0.5)
    assert found.p90 == 4


def test_nothing_has_no_distribution() -> None:
    assert histogram_of([]) is None
    assert figures_of([]) is None
