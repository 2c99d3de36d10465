from __future__ import annotations

from roslens.source.metrics.packages import dependencies
from roslens.source.metrics.packages.dependency_graph import dependency_graph


def test_an_empty_workspace_has_no_values():
    assert dependencies.of_graph(dependency_graph([])) == {}
