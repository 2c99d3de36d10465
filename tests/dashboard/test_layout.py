"""The picture of the graph: the same every time, nothing on top of anything else, calm when the graph grows."""

from __future__ import annotations

import random
import time
from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pace import turned_s

from roslens.dashboard.layout.lay_out import LABEL, Node, lay_out
from roslens.dashboard.layout.tiers import Edge

GRAPHS = st.integers(0, 24).flatmap(
    lambda count: st.tuples(
        st.lists(st.builds(Node, st.floats(6, 24), st.floats(10, 200)), min_size=count, max_size=count),
        st.lists(st.tuples(st.integers(0, max(0, count - 1)), st.integers(0, max(0, count - 1))), max_size=60)
        if count
        else st.just([]),
    )
)


def made_up(count: int, seed: int = 3) -> tuple[list[Node], list[Edge]]:
    chance = random.Random(seed)
    nodes = [Node(chance.uniform(6, 24), chance.uniform(40, 200)) for _ in range(count)]
    edges = [
        (node, int(chance.random() ** 2 * node)) for node in range(1, count) for _ in range(chance.choice((1, 2, 3)))
    ]
    return nodes, edges


@given(GRAPHS)
def test_it_is_the_same_every_time(graph: tuple[list[Node], list[Edge]]) -> None:
    nodes, edges = graph
    assert lay_out(nodes, edges) == lay_out(nodes, list(reversed(edges)))


@given(GRAPHS)
def test_no_disc_or_label_lies_on_another(graph: tuple[list[Node], list[Edge]]) -> None:
    nodes, edges = graph
    places = lay_out(nodes, edges).places
    boxes = []
    for node, (x, y) in zip(nodes, places, strict=True):
        half = max(node.radius, node.label / 2)
        boxes.append((x - half, x + half, y - node.radius, y + node.radius + LABEL))
    slack = 0.2  # places are rounded to a tenth
    for first, second in combinations(boxes, 2):
        beside = first[1] <= second[0] + slack or second[1] <= first[0] + slack
        above = first[3] <= second[2] + slack or second[3] <= first[2] + slack
        assert beside or above


@given(GRAPHS)
def test_everything_is_inside_the_picture(graph: tuple[list[Node], list[Edge]]) -> None:
    nodes, edges = graph
    layout = lay_out(nodes, edges)
    for node, (x, y) in zip(nodes, layout.places, strict=True):
        assert node.radius <= x + 0.2
        assert x <= layout.width - node.radius + 0.2
        assert 0 <= y <= layout.height


@given(GRAPHS)
def test_what_is_needed_stands_to_the_left(graph: tuple[list[Node], list[Edge]]) -> None:
    nodes, edges = graph
    layout = lay_out(nodes, edges)
    for dependent, needed in edges:
        if layout.cycles[dependent] != layout.cycles[needed]:
            assert layout.places[needed][0] < layout.places[dependent][0]
            assert layout.tiers[needed] < layout.tiers[dependent]


def test_one_more_node_moves_few_to_another_column() -> None:
    nodes, edges = made_up(60)
    before = lay_out(nodes, edges)
    after = lay_out([*nodes, Node(10, 80)], [*edges, (60, 0)])
    assert after.tiers[:60] == before.tiers
    moved = sum(first != second for first, second in zip(before.columns, after.columns, strict=False))
    assert moved <= 6


@pytest.mark.heavy
@pytest.mark.timed
def test_four_thousand_packages_are_placed_in_three_tenths_of_a_second() -> None:
    nodes, edges = made_up(4000)
    begun = time.process_time()
    layout = lay_out(nodes, edges)
    took = turned_s(begun)
    assert len(layout.places) == 4000
    assert took < 0.3, f"{took:.2f} s"
