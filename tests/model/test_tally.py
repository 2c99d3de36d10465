import statistics

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.traffic.tally import NOTHING, Moments

SERIES = st.lists(st.floats(0, 1e3), min_size=1, max_size=30)


def moments(values):
    return Moments(len(values), sum(values), sum(one * one for one in values), min(values), max(values))


@given(SERIES, SERIES)
def test_merging_is_the_same_as_measuring_both(one, other):
    both, merged = moments(one + other), moments(one).merged(moments(other))
    assert (merged.count, merged.least, merged.greatest) == (both.count, both.least, both.greatest)
    assert (merged.total, merged.squares) == pytest.approx((both.total, both.squares))


@given(SERIES)
def test_nothing_changes_nothing(values):
    one = moments(values)
    assert NOTHING.merged(one) == one == one.merged(NOTHING)


def test_mean_and_deviation():
    values = [1.0, 2.0, 4.0]
    assert moments(values).mean == pytest.approx(7 / 3)
    assert moments(values).deviation == pytest.approx(statistics.pstdev(values))
    assert NOTHING.mean is None
    assert NOTHING.deviation is None
