"""Coefficients, intervals and corrections, against values worked out by hand or by other means."""

import math

import numpy as np
import pytest

from roslens.model.study import Column, Corpus, Subject
from roslens.source.study.correlate import correlate


def corpus(columns, size_key="", sizes=()):
    keys = list(columns)
    rows = zip(*columns.values(), strict=True)
    packages = tuple(
        Subject(f"p{n}", values=dict(zip(keys, map(float, row), strict=True))) for n, row in enumerate(rows)
    )
    return Corpus("table", (), tuple(Column(key, key, size=key in sizes) for key in keys), packages, size_key=size_key)


def only(found):
    (one,) = found
    return one


def test_coefficients_by_hand():
    # Deviations from the means give products of 9 in sum, squares of 10 each. Ranks deviate by the same numbers.
    one = only(correlate(corpus({"x": [1, 2, 3, 4, 5], "y": [2, 3, 5, 4, 6]})))
    assert one.pearson.value == pytest.approx(0.9)
    assert one.spearman.value == pytest.approx(0.9)
    # The interval is symmetric in what Fisher transforms to.
    assert one.pearson.low == pytest.approx(math.tanh(math.atanh(0.9) - 1.959964 / math.sqrt(2)))
    # Bonett and Wright have a larger variance for ranks.
    assert one.spearman.high == pytest.approx(math.tanh(math.atanh(0.9) + 1.959964 * math.sqrt((1 + 0.405) / 2)))


def test_rank_correlation_sees_what_rises_without_a_line():
    one = only(correlate(corpus({"x": range(1, 9), "y": [10**n for n in range(8)]})))
    assert one.spearman.value == pytest.approx(1)
    assert one.pearson.value < 0.7


def test_size_held_fixed_takes_away_what_size_alone_brings():
    random = np.random.default_rng(7)
    size = random.integers(10, 1000, 80)
    found = correlate(
        corpus({"loc": size, "x": size + random.normal(0, 20, 80), "y": size + random.normal(0, 20, 80)}, "loc")
    )
    pair = next(one for one in found if (one.one, one.other) == ("x", "y"))
    assert pair.spearman.value > 0.95
    assert abs(pair.partial.value) < 0.4
    # The formula of three rank correlations, which is another way to the same number.
    r = {frozenset((one.one, one.other)): one.spearman.value for one in found}
    xy, xs, ys = (r[frozenset(pair)] for pair in (("x", "y"), ("loc", "x"), ("loc", "y")))
    assert pair.partial.value == pytest.approx((xy - xs * ys) / math.sqrt((1 - xs**2) * (1 - ys**2)))


def test_densities_are_of_quantities_that_grow_with_code():
    columns = {"loc": [10, 20, 30, 40, 50, 60], "x": [1, 4, 3, 8, 5, 12], "y": [2, 2, 6, 4, 10, 6]}
    found = correlate(corpus(columns, "loc", sizes=("x",)))
    assert all(one.density is None for one in found)
    found = correlate(corpus(columns, "loc", sizes=("x", "y")))
    # x / loc: .1 .2 .1 .2 .1 .2; y / loc: .2 .1 .2 .1 .2 .1
    assert next(one for one in found if one.density).density.value == pytest.approx(-1)


def test_probabilities_are_corrected_for_their_number():
    random = np.random.default_rng(3)
    found = correlate(corpus({f"q{n}": random.normal(0, 1, 30) for n in range(10)}))
    assert len(found) == 45
    by_p = sorted(found, key=lambda one: one.pearson.p)
    # Benjamini and Hochberg: p times the number of tests by its place, made to rise
    expected = 1.0
    for place, one in reversed(list(enumerate(by_p, 1))):
        expected = min(expected, one.pearson.p * 45 / place)
        assert one.pearson.adjusted == pytest.approx(expected)


@pytest.mark.parametrize("columns", [{"x": [1, 1, 1, 1, 1], "y": [1, 2, 3, 4, 5]}, {"x": [1, 2, 3], "y": [1, 2, 4]}])
def test_what_does_not_vary_or_is_rare_is_left_out(columns):
    assert not correlate(corpus(columns))
