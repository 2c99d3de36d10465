"""A node stands at the same place in the picture of what runs as in that of its source."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from dashboard import made_up_configurations as made_up

from roslens.cli.page.watch_graph import GraphPicture
from roslens.cli.served.source_grounds import source_grounds
from roslens.dashboard.computation.picture import computation_graph
from roslens.dashboard.computation.system import System
from roslens.model.graph import Graph, Node


def site_of(systems: dict[str, System]) -> Any:
    return SimpleNamespace(book=SimpleNamespace(systems=systems))


@pytest.mark.parametrize("size", ["robot", "large"])
def test_what_runs_stands_where_its_source_has_it(size: str) -> None:
    configuration = getattr(made_up, size)()
    system = System("rover", configuration)
    graph = computation_graph(system)
    drawing = graph.lines if graph.many else graph.topics
    marks = enumerate(graph.marks)
    static = {f"{mark.kind}:{mark.name}": drawing.places[at] for at, mark in marks if at in drawing.places}
    nodes = configuration.nodes[:-1]
    running = Graph(
        configuration.generation,
        nodes=tuple(Node(node.name) for node in nodes),
        endpoints=tuple(one.endpoint for node in nodes for one in node.endpoints if "*" not in one.endpoint.name),
    )
    picture = GraphPicture(str, source_grounds(site_of({"rover": system}))).of(running, ())
    shared = [one for one in picture.items if one.entity in static]
    assert len([one for one in shared if one.kind == "node"]) == len({node.name for node in nodes})
    assert {one.entity: (one.x, one.y) for one in shared} == {one.entity: static[one.entity] for one in shared}
    assert picture.as_lines == graph.many


def test_a_configuration_of_other_nodes_is_not_taken_for_its_source() -> None:
    grounds = source_grounds(site_of({"rover": System("rover", made_up.robot())}))
    assert grounds(["node:/other", "node:/third", "node:/lidar"]) is None
    assert grounds(["node:/lidar", "node:/other"]) is not None
