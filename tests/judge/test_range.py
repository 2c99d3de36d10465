"""Ranges: text form, membership, algebra."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.ranges.range import Range, plain

BOUND = st.one_of(st.none(), st.floats(allow_nan=False, allow_infinity=False), st.integers(-1000, 1000).map(float))
VALUE = st.one_of(st.floats(allow_nan=False), st.integers(-1000, 1000).map(float))


@st.composite
def ranges(draw: st.DrawFn) -> Range:
    low, high = draw(BOUND), draw(BOUND)
    if low is not None and high is not None and low > high:
        low, high = high, low
    return Range(low, high)


@pytest.mark.parametrize(
    ("text", "range_"),
    [
        ("1..15", Range(1, 15)),
        ("<= 15", Range(maximum=15)),
        (">= 20", Range(minimum=20)),
        ("0.25..2.5", Range(0.25, 2.5)),
        ("-3..-1", Range(-3, -1)),
        ("any", Range()),
    ],
)
def test_text_form_reads_as_people_write(text: str, range_: Range):
    assert str(range_) == text
    assert Range.parse(text) == range_


@pytest.mark.parametrize("text", ["  1 .. 15 ", "1..15", "+1..15.0", "1e0..1.5e1"])
def test_parse_takes_other_spellings(text: str):
    assert Range.parse(text) == Range(1, 15)


@pytest.mark.parametrize("text", ["", "15", "1...15", "< 15", "a..b", "1..", "..2", "nan..1", "<= inf", "1..2..3"])
def test_parse_refuses_what_is_no_range(text: str):
    with pytest.raises(ValueError, match="is not a range, expected a range such as"):
        Range.parse(text)


def test_parse_refuses_a_minimum_above_the_maximum():
    with pytest.raises(ValueError, match="minimum 20 is above maximum 1"):
        Range.parse("20..1")


@pytest.mark.parametrize("bound", [math.nan, math.inf, -math.inf])
def test_bounds_are_finite(bound: float):
    with pytest.raises(ValueError, match="expected a finite number"):
        Range(minimum=bound)
    with pytest.raises(ValueError, match="expected a finite number"):
        Range(maximum=bound)


def test_bounds_are_inside():
    assert 1 in Range(1, 15)
    assert 15 in Range(1, 15)
    assert 15.000001 not in Range(1, 15)
    assert 0.999999 not in Range(1, 15)
    assert math.nan not in Range()


def test_disjoint_ranges_do_not_intersect():
    assert Range(1, 2).intersect(Range(3, 4)) is None
    assert not Range(1, 2).overlaps(Range(3, 4))
    assert Range(1, 2).intersect(Range(2, 3)) == Range(2, 2)


@pytest.mark.parametrize(
    ("number", "text"), [(15.0, "15"), (0.25, "0.25"), (-0.0, "0"), (1e20, "1e+20"), (3, "3"), (-math.inf, "-inf")]
)
def test_plain_numbers(number: float, text: str):
    assert plain(number) == text


@given(ranges())
def test_text_form_survives_a_round_trip(range_: Range):
    assert Range.parse(str(range_)) == range_


@given(ranges(), ranges(), VALUE)
def test_intersection_holds_what_both_hold(one: Range, other: Range, value: float):
    both = one.intersect(other)
    assert (both is not None and value in both) == (value in one and value in other)


@given(ranges(), ranges())
def test_intersection_commutes_and_is_covered(one: Range, other: Range):
    both = one.intersect(other)
    assert both == other.intersect(one)
    assert one.overlaps(other) == (both is not None)
    if both is not None:
        assert one.covers(both)
        assert other.covers(both)


@given(ranges(), ranges(), VALUE)
def test_what_covers_holds_every_value(one: Range, other: Range, value: float):
    if one.covers(other) and value in other:
        assert value in one


@given(ranges())
def test_every_range_covers_itself_and_any_covers_it(range_: Range):
    assert range_.covers(range_)
    assert Range().covers(range_)
    assert range_.intersect(range_) == range_
