from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from roslens.source.metrics.class_model.inheritance import depths


def test_the_longest_way_counts():
    assert depths({"a": {"b", "d"}, "b": {"c"}, "c": set(), "d": set()}) == {"a": 2, "b": 1, "c": 0, "d": 0}


def test_a_parent_from_elsewhere_has_depth_zero():
    assert depths({"a": {"elsewhere"}, "b": {"a"}}) == {"a": 1, "b": 2}


def test_a_circle_comes_to_an_end():
    assert max(depths({"a": {"b"}, "b": {"c"}, "c": {"a"}}).values()) <= 3
    assert depths({"a": {"a"}}) == {"a": 1}


def test_a_chain_of_thousands_is_no_trouble():
    chain = {f"c{number}": {f"c{number + 1}"} for number in range(5000)}
    assert depths(chain)["c0"] == 5000


@given(st.dictionaries(st.integers(0, 9), st.sets(st.integers(0, 9))))
def test_without_circles_a_child_is_deeper_than_its_parents(targets):
    parents = {str(child): {str(one) for one in above if one > child} for child, above in targets.items()}
    found = depths(parents)
    assert found.keys() == parents.keys()
    for child, above in parents.items():
        assert found[child] == (1 + max(found.get(one, 0) for one in above) if above else 0)
