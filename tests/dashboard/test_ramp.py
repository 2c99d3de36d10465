"""Colours relative to what is visible: the worst is darkest, zero and unknown are steps of their own."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from roslens.dashboard.charts.ramp import ramp_of
from roslens.model.quantity import Better


def test_the_most_is_darkest_and_zero_is_a_step_of_its_own() -> None:
    ramp = ramp_of([0, 1, 25, 100, None])
    assert [ramp.step(value) for value in (0, 1, 4, 5, 16, 25, 64, 100)] == ["0", "1", "1", "2", "2", "3", "4", "5"]
    assert ramp.step(None) == "n"


def test_colours_adapt_when_the_most_is_gone() -> None:
    assert ramp_of([3, 100]).step(3) == "1"
    assert ramp_of([3, 1]).step(3) == "5"


def test_the_legend_prints_the_numbers_of_each_step() -> None:
    assert ramp_of([0, 100]).legend() == [
        ("0", "0"), ("1", "1 to 4"), ("2", "5 to 16"), ("3", "17 to 36"), ("4", "37 to 64"), ("5", "65 to 100"),
    ]  # fmt: skip
    assert ramp_of([2]).legend() == [("0", "0"), ("4", "1"), ("5", "2")]
    assert ramp_of([0]).legend() == [("0", "0")]


def test_where_more_is_better_the_least_is_darkest() -> None:
    ramp = ramp_of([20.0, 60.0, 120.0], Better.HIGHER)
    assert [ramp.step(value) for value in (120.0, 60.0, 20.0)] == ["1", "4", "5"]
    assert ramp.legend()[0] == ("1", "100 to 120")
    assert ramp_of([7.0], Better.HIGHER).step(7.0) == "1"


@given(st.lists(st.integers(0, 10_000), min_size=1, max_size=40))
def test_more_is_never_paler_and_the_legend_is_true(values: list[int]) -> None:
    ramp = ramp_of(values)
    steps = [ramp.step(value) for value in sorted(values)]
    assert steps == sorted(steps)
    if max(values):
        assert ramp.step(max(values)) == "5"
    ends = {step: [int(end.replace(",", "")) for end in text.split(" to ")] for step, text in ramp.legend()}
    for value in values:
        low, high = ends[ramp.step(value)][0], ends[ramp.step(value)][-1]
        assert low <= value <= high
