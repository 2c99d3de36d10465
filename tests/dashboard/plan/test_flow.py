"""Nodes stand where most flows from left to right."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from roslens.dashboard.plan.flow import ordered, tiers

FLOWS = st.integers(1, 12).flatmap(
    lambda count: st.tuples(
        st.just(count),
        st.dictionaries(
            st.tuples(st.integers(0, count - 1), st.integers(0, count - 1)), st.integers(1, 4), max_size=30
        ),
    )
)


@given(FLOWS)
def test_every_node_has_one_place(made: tuple[int, dict[tuple[int, int], int]]) -> None:
    count, flows = made
    assert sorted(ordered(count, flows)) == list(range(count))
    found = tiers(count, flows, 4)
    assert len(found) == count
    assert all(0 <= tier < 4 for tier in found)
    assert tiers(count, dict(reversed(flows.items())), 4) == found


@given(FLOWS)
def test_without_cycles_everything_flows_to_the_right(made: tuple[int, dict[tuple[int, int], int]]) -> None:
    count, flows = made
    ahead = {pair: amount for pair, amount in flows.items() if pair[0] < pair[1]}
    found = tiers(count, ahead, count)
    assert all(found[source] < found[target] for source, target in ahead)


def test_the_smaller_flow_of_a_cycle_goes_back() -> None:
    assert tiers(3, {(0, 1): 3, (1, 2): 3, (2, 0): 1}, 9) == [0, 1, 2]
    assert tiers(3, {(0, 1): 1, (1, 2): 3, (2, 0): 3}, 9) == [2, 0, 1]


def test_who_takes_nothing_stands_beside_who_takes_from_it() -> None:
    # A joystick that only the last of a chain listens to.
    assert tiers(4, {(0, 1): 1, (1, 2): 1, (3, 2): 1}, 9) == [0, 1, 2, 1]
