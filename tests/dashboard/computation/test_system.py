"""From a configuration to elements and wires."""

from __future__ import annotations

from types import ModuleType

import msgspec
import pytest

from roslens.dashboard.computation.system import Kind, System, systems_of
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, Proof
from roslens.model.finding import Finding, Severity
from roslens.model.graph import Endpoint, Role


@pytest.fixture(scope="module")
def system(made_up: ModuleType) -> System:
    return System("rover", made_up.robot(), made_up.robot_findings())


def named(system: System, name: str) -> int:
    return next(number for number, element in enumerate(system.elements) if element.name == name)


def test_messages_and_requests_flow_from_who_gives_them(system: System) -> None:
    wires = {(system.elements[wire.source].name, system.elements[wire.target].name) for wire in system.wires}
    assert ("/lidar", "/scan") in wires
    assert ("/scan", "/navigation/planner") in wires
    assert ("/navigation/planner", "/odometry/reset") in wires
    assert ("/odometry/reset", "/odometry") in wires
    assert ("/mission", "/navigation/navigate") in wires
    assert ("/navigation/navigate", "/navigation/planner") in wires
    assert (
        len(system.ends)
        == sum(len(node.endpoints) for node in system.nodes)
        == sum(len(w.endpoints) for w in system.wires)
    )


def test_an_element_says_how_sure_it_is(system: System) -> None:
    objects = system.elements[named(system, "/navigation/*/objects")]
    assert (objects.sure, objects.resolved, objects.conditional) == ("possible", False, True)
    assert system.elements[named(system, "/odometry/reset")].sure == "likely"
    assert system.elements[named(system, "/navigation/detector")].conditional
    assert system.elements[named(system, "/navigation/debug/costs")].resolved
    assert system.elements[named(system, "/scan")].severity == "error"
    assert [one.rule for one in system.findings_on(system.elements[named(system, "/mission")])] == ["graph.clock"]


def test_names_that_are_not_known_in_full_join_no_nodes() -> None:
    def node(name: str, role: Role) -> ConfiguredNode:
        end = ConfiguredEndpoint(Endpoint(name, role, "/*"), Proof("a.py", 1), resolved=False)
        return ConfiguredNode(name, Proof("a.py", 1), endpoints=(end, end))

    one = System("s", Configuration("c", "ros2", (node("/a", Role.PUBLISHER), node("/b", Role.SUBSCRIPTION))))
    assert [element.key for element in one.elements] == ["node/a", "node/b", "topic/*", "topic/*~2"]
    assert [(wire.source, wire.target) for wire in one.wires] == [(0, 2), (3, 1)]


def test_what_every_node_has_is_told_apart(system: System) -> None:
    assert "implicit" in system.elements[named(system, "/rosout")].noise
    assert "implicit" not in system.elements[named(system, "/tf")].noise


def test_an_element_stands_in_the_innermost_namespace_with_nodes(system: System) -> None:
    lanes = {element.name: element.lane for element in system.elements}
    assert lanes["/left/image_raw"] == "/left"
    assert lanes["/navigation/debug/costs"] == "/navigation"
    assert lanes["/odometry/reset"] == "/"


def test_nodes_of_one_name_have_pages_of_their_own(made_up: ModuleType) -> None:
    robot = made_up.robot()
    doubled = msgspec.structs.replace(robot, nodes=(robot.nodes[0], robot.nodes[0]))
    found = [element.key for element in System("x", doubled).elements if element.kind is Kind.NODE]
    assert found == ["node/container", "node/container~2"]


def test_slugs_fit_an_address_and_differ() -> None:
    empty = Configuration("", "ros2")
    found = systems_of({"a b/c": empty, "a-b-c": empty, "\N{SNOWMAN}": empty})
    assert list(found) == ["a-b-c", "a-b-c-2", "system"]


def test_of_a_node_without_any_name_it_is_told_what_it_runs() -> None:
    started = ConfiguredNode("/*", Proof("a.launch.py", 1), resolved=False, executable="camera::CameraNode")
    assert System("s", Configuration("t", "ros2", (started,))).elements[0].program == "CameraNode"


def test_what_is_wrong_with_a_parameter_stands_on_its_node() -> None:
    finding = Finding("graph.parameter_type", Severity.ERROR, "of another type", entity="parameter:/a/b:rate")
    system = System("s", Configuration("t", "ros2", (ConfiguredNode("/a/b", Proof()),)), (finding,))
    assert system.findings_on(system.elements[0]) == (finding,)
    assert system.elements[0].severity == "error"


def test_what_holds_for_several_is_shown_on_each(made_up: ModuleType) -> None:
    both = Finding("graph.remap", Severity.WARNING, "m", entity="node:/left/camera", also=("node:/right/camera",))
    one = System("rover", made_up.robot(), (both,))
    for name in ("/left/camera", "/right/camera"):
        element = one.elements[named(one, name)]
        assert element.severity == "warning"
        assert one.findings_on(element) == (both,)
    assert one.elements_of(both) == (named(one, "/left/camera"), named(one, "/right/camera"))
    assert one.elements[named(one, "/lidar")].severity == ""
