from accuracy import ros2
from accuracy.system import System
from roslens.model.graph import Endpoint, Graph, Node, Role

SYSTEM = System("a robot", "ros2", "p/x.launch", (), "It.", 1, commands=("p/node",), needs=("no_such_module",))


def test_the_node_of_the_launch_system_is_no_part_of_it():
    own = Endpoint("/launch_ros_7", Role.PUBLISHER, "/rosout")
    graph = Graph("ros2", (Node("/launch_ros_7"), Node("/n")), (own,), parameters={"/launch_ros_7": {}, "/n": {}})
    assert ros2._without_launcher(graph) == Graph("ros2", (Node("/n"),), parameters={"/n": {}})


def test_what_is_missing_is_named(monkeypatch):
    monkeypatch.setenv("ROSLENS_ROS2_PYTHON", "/nowhere/python")
    assert "rclpy" in ros2.why_not(SYSTEM)


def test_a_domain_is_one_that_exists():
    assert 60 <= ros2.free_domain() < 160
