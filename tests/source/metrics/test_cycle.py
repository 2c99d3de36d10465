from __future__ import annotations

from roslens.source.metrics.packages import cycle
from roslens.source.metrics.packages.dependency_graph import dependency_graph


def test_a_ring_of_thousands_is_no_trouble(package_of):
    packages = [package_of(f"p{number}: p{(number + 1) % 5000}") for number in range(5000)]
    assert set(cycle.of_graph(dependency_graph(packages)).values()) == {5000}


def test_two_rings_that_share_a_package_are_one(package_of):
    packages = [package_of(line) for line in ("a: b", "b: a c", "c: b", "d: a")]
    assert cycle.of_graph(dependency_graph(packages)) == {"a": 3, "b": 3, "c": 3, "d": 0}
