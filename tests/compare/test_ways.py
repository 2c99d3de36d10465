from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.compare.ways import fewest

CONDITIONS = ["a", "not a", "b", "not b", "c", "not c"]


@pytest.mark.parametrize(
    ("ways", "left"),
    [
        ([("a",), ("not a",)], [()]),
        ([("a", "b"), ("not a", "b")], [("b",)]),
        ([("a",), ()], [()]),
        ([("a",), ("b",)], [("a",), ("b",)]),
        ([("a", "b"), ("not a", "b"), ("not b",)], [()]),
        ([("#if X > 1",), ("not #if X > 1",)], [()]),
        ([], []),
    ],
)
def test_what_is_said_twice_is_left_out(ways, left):
    assert list(fewest(ways)) == left


def holds(ways, world):
    return any(all(world[one.removeprefix("not ")] != one.startswith("not ") for one in way) for way in ways)


@given(st.lists(st.lists(st.sampled_from(CONDITIONS), max_size=4).map(tuple), max_size=6))
def test_it_holds_exactly_where_the_ways_do(ways):
    left = fewest(ways)
    assert len(left) <= len(set(ways))
    for values in product((False, True), repeat=3):
        world = dict(zip("abc", values, strict=True))
        assert holds(left, world) == holds(ways, world)


@given(st.permutations([("a", "b"), ("not a", "b"), ("c",), ("not b",)]))
def test_the_order_does_not_matter(ways):
    assert fewest(ways) == fewest(sorted(ways))
