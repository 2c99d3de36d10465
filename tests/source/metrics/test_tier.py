from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from roslens.source.metrics.packages import tier
from roslens.source.metrics.packages.dependency_graph import dependency_graph

LINES = st.lists(st.lists(st.sampled_from("abcdef"), max_size=4), min_size=6, max_size=6)


@given(LINES)
def test_a_package_never_stands_below_what_it_needs(package_of, targets):
    lines = [f"{name}: {' '.join(target)}" for name, target in zip("abcdef", targets, strict=True)]
    graph = dependency_graph([package_of(line) for line in lines])
    tiers = tier.of_graph(graph)
    together = {name: component for component in graph.components for name in component}
    for package, needed in graph.below.items():
        for target in needed:
            if together[package] == together[target]:
                assert tiers[package] == tiers[target]
            else:
                assert tiers[package] > tiers[target]
    assert set(tiers.values()) == set(range(int(max(tiers.values())) + 1))


def test_a_chain_of_thousands_is_no_trouble(package_of):
    packages = [package_of(f"p{number}: p{number + 1}") for number in range(5000)]
    assert tier.of_graph(dependency_graph(packages))["p0"] == 4999
