"""A bucket that grows tally by tally is the sum of its tallies."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.window.bucket import Bucket, Sums, joined
from roslens.model.traffic.tally import NOTHING, Moments, Tally

VALUES = st.lists(st.floats(0.001, 10), min_size=1, max_size=5)


def of(values):
    return Moments(len(values), sum(values), sum(one * one for one in values), min(values), max(values))


def tally(number, gaps, latencies):
    return Tally(
        "/a", "/p", "/s", number, number + 1.0, len(gaps), 10 * len(gaps), number + 0.1, number + 0.9,
        of(gaps), of(latencies), lost=1,
    )  # fmt: skip


@given(st.lists(VALUES, min_size=1, max_size=5))
def test_it_holds_the_moments_of_all(parts):
    tallies = [tally(number, part, part) for number, part in enumerate(parts)]
    bucket = Bucket.of(tallies[0], 0.0)
    for number, one in enumerate(tallies[1:]):
        bucket.extend(one, number + 0.9)
    every = [value for part in parts for value in part]
    for series in (bucket.period, bucket.latency):
        assert (series.count, series.least, series.greatest) == (len(every), min(every), max(every))
        assert series.total == pytest.approx(sum(every))
        assert series.squares == pytest.approx(sum(one * one for one in every))
        assert series.mean == pytest.approx(of(every).mean)
        # Sums of squares know a deviation up to the square root of the rounding of one square.
        assert series.deviation == pytest.approx(of(every).deviation, abs=1e-7 * max(every))
    assert (bucket.count, bucket.bytes, bucket.lost) == (len(every), 10 * len(every), len(parts))
    assert (bucket.end, bucket.gap) == (len(parts), max(every))


def test_twins_grow_apart():
    first = Bucket.of(tally(0, [1.0], [2.0]), 0.0)
    first.extend(tally(1, [1.0], [2.0]), 0.9)
    second = first.twin()
    second.extend(tally(2, [5.0], [2.0]), 1.9)
    assert (first.period.count, first.period.greatest, second.period.count, second.period.greatest) == (2, 1.0, 3, 5.0)


def test_what_grows_elsewhere_is_not_taken_over():
    grown = joined(of([1.0]), of([2.0]))
    assert isinstance(grown, Sums)
    mine = joined(NOTHING, grown)
    grown.take(of([3.0]))
    assert (mine.count, grown.count) == (2, 3)
