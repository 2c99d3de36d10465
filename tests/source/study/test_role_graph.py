"""What nodes say to others tells a role, each mark with the type that shows it."""

import msgspec
import pytest

from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, Origin, Proof
from roslens.model.graph import Endpoint, Role
from roslens.model.source import Dependency, Language, Location, Package, SourceFile
from roslens.source.study.role import decide
from roslens.source.study.role_graph import Spoken, marks_of_graph, plain, spoken_by_package
from roslens.source.study.role_marks import RoleFacts

HERE = Proof("a.cpp", 3)
HERE_TOO = Location("package.xml")


def node(package, *endpoints, role="", origin=Origin.CODE):
    made = tuple(
        ConfiguredEndpoint(Endpoint("/n", kind, "/x", type_), Proof("a.cpp", 3, origin=origin))
        for kind, type_ in endpoints
    )
    return ConfiguredNode("/n", HERE, package=package, endpoints=made, role=role)


def test_what_own_nodes_speak_in_all_graphs():
    graphs = [
        Configuration("a", "ros2", nodes=(node("base", (Role.SUBSCRIPTION, "geometry_msgs/msg/Twist")),)),
        Configuration(
            "b",
            "ros1",
            nodes=(
                node("base", (Role.PUBLISHER, "sensor_msgs/Imu"), (Role.PUBLISHER, "")),
                node("base", (Role.PUBLISHER, "a/B"), role="test"),
                node("base", (Role.PUBLISHER, "rcl_interfaces/msg/Log"), origin=Origin.IMPLICIT),
                node("", (Role.PUBLISHER, "a/C")),
                node("go", (Role.ACTION_CLIENT, "move_base_msgs/MoveBaseAction")),
            ),
        ),
    ]
    assert spoken_by_package(graphs) == {
        "base": Spoken(("sensor_msgs/Imu",), ("geometry_msgs/Twist",)),
        "go": Spoken(asked=("move_base_msgs/MoveBaseAction",)),
    }


def test_types_of_both_generations_are_one():
    assert plain("sensor_msgs/msg/Imu") == plain("sensor_msgs/Imu") == "sensor_msgs/Imu"


@pytest.mark.parametrize(
    ("spoken", "marks"),
    [
        (Spoken(("sensor_msgs/Imu",)), {"graph_measures"}),
        (Spoken(("sensor_msgs/Imu",), ("sensor_msgs/LaserScan",)), set()),
        (Spoken((), ("geometry_msgs/Twist",)), {"graph_obeys"}),
        (Spoken(("geometry_msgs/Twist",), ("sensor_msgs/Joy",)), {"graph_commands"}),
        # Who passes commands on is neither.
        (Spoken(("geometry_msgs/Twist",), ("geometry_msgs/Twist",)), set()),
        (Spoken(asked=("nav2_msgs/NavigateToPose",)), {"graph_asks"}),
        (Spoken(asked=("std_srvs/Empty",)), set()),
        (None, set()),
    ],
)
def test_marks(spoken, marks):
    assert set(marks_of_graph(spoken)) == marks


def test_a_graph_tells_what_a_name_does_not():
    needs = (Dependency("rclcpp", "depend", HERE_TOO),)
    nameless = RoleFacts(
        Package("wanderer", "wanderer", ".", HERE_TOO, dependencies=needs),
        (SourceFile("src/node.cpp", Language.CPP),),
        "repo",
        nodes=True,
    )
    assert decide(nameless).role == "library"
    graphs = {
        "driver": Spoken(("sensor_msgs/Imu",), ("geometry_msgs/Twist",)),
        "application": Spoken(("geometry_msgs/Twist",), ("sensor_msgs/Joy",), ("nav2_msgs/NavigateToPose",)),
    }
    for role, spoken in graphs.items():
        found = decide(msgspec.structs.replace(nameless, spoken=spoken))
        assert found.role == role
        assert any("its nodes" in reason for reason in found.reasons)
