"""What differs is marked where the picture of the source has it."""

from __future__ import annotations

from types import ModuleType

import msgspec
import pytest

from roslens.compare.conformance.configured import source_side
from roslens.compare.conformance.join import conformance
from roslens.compare.conformance.observed import running_side
from roslens.dashboard.computation.difference_picture import (
    SIGNS,
    WORDS,
    DifferencePicture,
    Element,
    Standing,
    difference_picture,
)
from roslens.dashboard.computation.picture import computation_graph
from roslens.dashboard.computation.system import System
from roslens.model.graph import Endpoint, Graph, Node, Role


def compared(system: System, graph: Graph) -> DifferencePicture:
    side = running_side(graph, "what runs")
    found = conformance([source_side(system.configuration, "source", ()), side])
    return difference_picture(system, found.disparities, [side])


def known(graph: Graph) -> Graph:
    """Return a graph without what source does not know the name of."""
    ends = tuple(one for one in graph.endpoints if "*" not in one.name)
    return msgspec.structs.replace(graph, endpoints=ends)


@pytest.fixture(scope="module")
def system(made_up: ModuleType) -> System:
    return System("rover", made_up.robot())


@pytest.fixture(scope="module")
def running(system: System) -> Graph:
    """Return what runs: no lidar, one node more, and a topic of another type."""
    graph = known(system.configuration.graph())
    ends = [one for one in graph.endpoints if one.node != "/lidar"]
    ends = [msgspec.structs.replace(one, type="other_msgs/msg/Other") if one.name == "/odom" else one for one in ends]
    more = Endpoint("/joystick", Role.PUBLISHER, "/cmd_vel", "geometry_msgs/msg/Twist")
    own = Endpoint("/joystick", Role.PUBLISHER, "/joy", "sensor_msgs/msg/Joy")
    nodes = [one for one in graph.nodes if one.name != "/lidar"]
    return msgspec.structs.replace(graph, nodes=(*nodes, Node("/joystick")), endpoints=(*ends, more, own))


def by_key(picture: DifferencePicture) -> dict[str, Element]:
    return {one.key: one for one in picture.elements}


def test_elements_are_marked_by_how_they_stand_to_source(system: System, running: Graph) -> None:
    found = by_key(compared(system, running))
    assert found["node:/lidar"].standing is Standing.MISSING
    assert found["node:/joystick"].standing is Standing.ADDED
    assert found["topic:/joy"].standing is Standing.ADDED
    assert found["topic:/odom"].standing is Standing.DIFFERS
    assert found["node:/odometry"].standing is Standing.ALIKE
    assert any("differs in type" in text for text in found["topic:/odom"].differences)


def test_lines_are_marked_too(system: System, running: Graph) -> None:
    standings = {one.about.partition(":")[0]: one.standing for one in compared(system, running).lines}
    assert standings["/lidar \N{RIGHTWARDS ARROW} /scan"] is Standing.MISSING
    assert standings["/joystick \N{RIGHTWARDS ARROW} /cmd_vel"] is Standing.ADDED
    assert standings["/odometry \N{RIGHTWARDS ARROW} /tf"] is Standing.ALIKE


def test_everything_that_source_knows_stands_where_its_page_has_it(system: System, running: Graph) -> None:
    graph = computation_graph(system)
    found = by_key(compared(system, running))
    for number, place in graph.topics.places.items():
        one = found[f"{graph.marks[number].kind}:{graph.marks[number].name}"]
        assert (one.x, one.y) == place


def test_a_large_system_is_drawn_with_topics_as_lines_in_the_same_places(made_up: ModuleType) -> None:
    large = System("large", made_up.large())
    graph = known(large.configuration.graph())
    gone = graph.nodes[3].name
    nodes = tuple(one for one in graph.nodes if one.name != gone)
    ends = tuple(one for one in graph.endpoints if one.node != gone)
    picture = compared(large, msgspec.structs.replace(graph, nodes=nodes, endpoints=ends))
    assert picture.as_lines
    assert {one.kind for one in picture.elements} == {"node"}
    assert by_key(picture)[f"node:{gone}"].standing is Standing.MISSING
    drawn = computation_graph(large)
    for number, place in drawn.lines.places.items():
        one = by_key(picture)[f"node:{drawn.marks[number].name}"]
        assert (one.x, one.y) == place
    own = [line for line in picture.lines if gone in line.about.partition(":")[0].split(" \N{RIGHTWARDS ARROW} ")]
    assert own
    assert {line.standing for line in own} == {Standing.MISSING}


def test_nothing_differs_from_itself(system: System) -> None:
    picture = compared(system, known(system.configuration.graph()))
    assert not picture.count(Standing.ADDED) + picture.count(Standing.MISSING)


def test_each_mark_is_a_sign_and_a_word() -> None:
    marked = [one for one in Standing if one is not Standing.ALIKE]
    assert len({SIGNS[one] for one in marked}) == len({WORDS[one] for one in marked}) == 3
    assert all(SIGNS[one] for one in marked)
