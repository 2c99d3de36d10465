"""Tiers, cycles and the edges that say something new, held against definitions worked out the slow way."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from roslens.dashboard.layout.tiers import cycles_of, needs_of, reduce_edges, tiers_of

COUNT = 9
EDGES = st.lists(st.tuples(st.integers(0, COUNT - 1), st.integers(0, COUNT - 1)), max_size=30)


def reach(needs: list[list[int]]) -> list[set[int]]:
    found = []
    for start in range(len(needs)):
        seen: set[int] = set()
        rim = list(needs[start])
        while rim:
            node = rim.pop()
            if node not in seen:
                seen.add(node)
                rim += needs[node]
        found.append(seen)
    return found


def test_a_chain_with_a_short_cut() -> None:
    needs = needs_of(3, [(2, 1), (1, 0), (2, 0), (2, 2), (2, 1)])
    assert needs == [[], [0], [0, 1]]
    component = cycles_of(needs)
    assert tiers_of(needs, component) == [0, 1, 2]
    assert reduce_edges(needs, component) == [(1, 0), (2, 1)]


def test_a_cycle_is_one_step_and_keeps_its_edges() -> None:
    needs = needs_of(4, [(0, 1), (1, 0), (2, 1), (0, 3)])
    component = cycles_of(needs)
    assert component[0] == component[1]
    assert tiers_of(needs, component) == [1, 1, 2, 0]
    assert (0, 1) in reduce_edges(needs, component)
    assert (1, 0) in reduce_edges(needs, component)


@given(EDGES)
def test_components_are_the_nodes_that_reach_each_other(edges: list[tuple[int, int]]) -> None:
    needs = needs_of(COUNT, edges)
    component = cycles_of(needs)
    reached = reach(needs)
    for first in range(COUNT):
        for second in range(COUNT):
            mutual = first == second or (second in reached[first] and first in reached[second])
            assert (component[first] == component[second]) == mutual
            if second in reached[first]:
                assert component[second] <= component[first]


@given(EDGES)
def test_reduction_keeps_what_can_be_reached_and_nothing_twice(edges: list[tuple[int, int]]) -> None:
    needs = needs_of(COUNT, edges)
    component = cycles_of(needs)
    kept = reduce_edges(needs, component)
    assert reach(needs_of(COUNT, kept)) == reach(needs)
    for edge in kept:
        if component[edge[0]] != component[edge[1]]:
            others = [
                other
                for other in kept
                if (component[other[0]], component[other[1]]) != tuple(component[end] for end in edge)
            ]
            assert edge[1] not in reach(needs_of(COUNT, others))[edge[0]]


@given(EDGES)
def test_what_is_needed_is_in_a_lower_tier_unless_both_need_each_other(edges: list[tuple[int, int]]) -> None:
    needs = needs_of(COUNT, edges)
    component = cycles_of(needs)
    tiers = tiers_of(needs, component)
    for node, targets in enumerate(needs):
        for target in targets:
            assert tiers[target] < tiers[node] or component[target] == component[node]
