from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from roslens.model.relations.strongly_connected import strongly_connected
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.source.metrics.packages.dependency_graph import dependency_graph


def graph_of(package_of, *lines):
    return dependency_graph([package_of(line) for line in lines])


def test_edges_stay_inside_the_workspace_and_names_do_not(package_of):
    graph = graph_of(package_of, "a: b boost", "b:")
    assert graph.below == {"a": ("b",), "b": ()}
    assert graph.declared == {"a": {"b", "boost"}, "b": frozenset()}


def test_what_is_not_needed_makes_no_edge(package_of):
    graph = graph_of(package_of, "a: -b conflict/b replace/b doc/b", "b:")
    assert graph.below == {"a": (), "b": ()}


def test_a_group_stands_for_its_members_and_not_for_itself(package_of):
    graph = graph_of(package_of, "a: group/g", "b(g):", "c(g): group/g", "g:")
    assert graph.below == {"a": ("b", "c"), "b": (), "c": ("b",), "g": ()}


def test_an_inactive_membership_is_none(package_of):
    member = package_of("b(g):")
    member = replace(member, member_of_groups=tuple(replace(one, active=False) for one in member.member_of_groups))
    assert dependency_graph([package_of("a: group/g"), member]).below == {"a": (), "b": ()}


def test_a_name_that_two_packages_have_means_both(package_of):
    twin = replace(package_of("b: c"), id="b@other", path="other")
    assert dependency_graph([package_of("a: b"), package_of("b:"), twin]).below["a"] == ("b", "b@other")


def test_files_outside_packages_are_no_package(package_of):
    outside = replace(package_of("x: a"), id=OUTSIDE_PACKAGES, name=OUTSIDE_PACKAGES)
    assert dependency_graph([package_of("a:"), outside]).below == {"a": ()}


def test_the_order_of_packages_does_not_matter(package_of):
    lines = ("a: b c", "b: c", "c:")
    assert graph_of(package_of, *lines) == graph_of(package_of, *reversed(lines))


@given(st.dictionaries(st.integers(0, 7), st.sets(st.integers(0, 7)), min_size=8, max_size=8))
def test_components_are_those_that_reach_each_other_in_order(targets):
    below = {str(node): tuple(sorted(map(str, reached))) for node, reached in sorted(targets.items())}
    reach = {node: set(below[node]) for node in below}
    for middle in below:
        for node in below:
            if middle in reach[node]:
                reach[node] |= reach[middle]
    components = list(strongly_connected(below, below.__getitem__))
    assert sorted(node for component in components for node in component) == sorted(below)
    for place, component in enumerate(components):
        for node in component:
            assert set(component) == {one for one in below if node in reach[one] and one in reach[node]} | {node}
            assert not any(set(after) & reach[node] - set(component) for after in components[place + 1 :])
