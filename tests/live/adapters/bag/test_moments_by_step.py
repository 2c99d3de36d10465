"""Series cut into steps, against loops over their values."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.bag.moments_by_step import edges_of, greatest_of, moments_of


@given(st.lists(st.lists(st.integers(0, 9), min_size=1, max_size=6), max_size=6), st.sampled_from([1, 100]))
def test_steps_are_those_of_loops(steps, times):
    steps = [step * times for step in steps]
    numbers = np.array([3 * index for index, step in enumerate(steps) for _ in step], np.int64)
    values = np.array([value for step in steps for value in step], np.int64)
    edges = edges_of(numbers)
    assert edges.tolist() == [sum(map(len, steps[:index])) for index in range(len(steps))]
    found = greatest_of(edges, values)
    assert [place - edge for place, edge in zip(found.tolist(), edges.tolist(), strict=True)] == [
        step.index(max(step)) for step in steps
    ]
    moments = moments_of(numbers[edges], edges, values)
    assert list(moments) == [3 * index for index in range(len(steps))]
    for step, one in zip(steps, moments.values(), strict=True):
        assert (one.count, one.least, one.greatest) == (len(step), min(step) / 10**9, max(step) / 10**9)
        assert one.total == pytest.approx(sum(step) / 10**9)
        assert one.squares == pytest.approx(sum(value * value for value in step) / 10**18)
