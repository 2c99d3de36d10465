from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from roslens.source.metrics.packages import dependents
from roslens.source.metrics.packages.dependency_graph import dependency_graph

LINES = st.lists(st.lists(st.sampled_from("abcdef"), max_size=4), min_size=6, max_size=6)


@given(LINES)
def test_all_dependents_are_as_many_as_all_edges(package_of, targets):
    lines = [f"{name}: {' '.join(target)}" for name, target in zip("abcdef", targets, strict=True)]
    edges = sum(len(set(target) - {name}) for name, target in zip("abcdef", targets, strict=True))
    assert sum(dependents.of_graph(dependency_graph([package_of(line) for line in lines])).values()) == edges
