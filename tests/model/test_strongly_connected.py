"""Strongly connected components."""

from hypothesis import given
from hypothesis import strategies as st

from roslens.model.relations.strongly_connected import strongly_connected


def test_what_is_led_to_comes_first_and_circles_are_one():
    targets = {"a": ["b"], "b": ["c"], "c": ["b", "d"], "d": [], "e": ["a"]}
    found = [sorted(one) for one in strongly_connected(targets, targets.__getitem__)]
    assert found == [["d"], ["b", "c"], ["a"], ["e"]]


def test_a_long_chain_exhausts_no_stack():
    found = list(strongly_connected([0], lambda one: [one + 1] if one < 50_000 else []))
    assert found[0] == [50_000]
    assert len(found) == 50_001


@given(st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7)), max_size=20))
def test_two_are_in_one_component_if_each_is_reached_from_the_other(edges):
    targets = {one: sorted({to for from_, to in edges if from_ == one}) for one in range(8)}
    reached = {one: _reached(one, targets) for one in targets}
    components = list(strongly_connected(targets, targets.__getitem__))
    place = {one: number for number, component in enumerate(components) for one in component}
    assert sorted(place) == list(targets)
    for one in targets:
        for other in targets:
            assert (place[one] == place[other]) == (one in reached[other] and other in reached[one])
        assert all(place[to] <= place[one] for to in targets[one])


def _reached(start, targets):
    found, waiting = {start}, [start]
    while waiting:
        for to in targets[waiting.pop()]:
            if to not in found:
                found.add(to)
                waiting.append(to)
    return found
