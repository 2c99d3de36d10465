import pytest

from accuracy.facts import NODE
from accuracy.reading import lay_out, read
from accuracy.system import systems

ROBOT = systems()["robot_ros2"]


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    folder = tmp_path_factory.mktemp("robot")
    source = lay_out(ROBOT, folder)
    assert (source / "robot_ros2" / "scripts" / "ros2_lidar.py").exists()
    return read(ROBOT, folder)


def test_nodes_are_those_of_the_launch_file(told):
    assert [one.node for one in told if one.kind == NODE] == [
        "/front_lidar",
        "/odometry",
        "/rover/camera",
        "/rover/planner",
    ]


def test_ends_have_their_type_and_quality(told):
    (scan,) = [one for one in told if one.kind == "publisher" and one.name == "/scan"]
    assert (scan.values["type"], scan.values["reliability"]) == ("sensor_msgs/msg/LaserScan", "best_effort")
