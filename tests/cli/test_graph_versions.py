"""One source tree for ROS 1 and ROS 2: what is for one version is never shown with what is for the other."""

from pathlib import Path

import pytest

from roslens.cli.graph.graph_source import GraphSource
from roslens.source.settings import SourceSettings

BOTH = str(Path(__file__).parents[1] / "fixtures" / "workspaces" / "both_versions")


@pytest.fixture(scope="module")
def found():
    with GraphSource(BOTH, SourceSettings(), "roslens.toml", {}) as source:
        yield source


@pytest.fixture(scope="module")
def whole(found):
    return {one.generation: one for one in found.packages(())}


def ends(configuration, package):
    return {
        (end.endpoint.name, end.endpoint.type, end.proof.path)
        for node in configuration.nodes
        if node.package == package
        for end in node.endpoints
        if not end.implicit
    }


def test_each_version_has_its_own_programs(whole):
    assert {version: sorted({node.package for node in one.nodes}) for version, one in whole.items()} == {
        "ros1": ["camera", "driver", "lidar", "sonar"],
        "ros2": ["camera", "driver", "lidar", "sonar"],
    }


def test_code_for_both_has_the_types_of_the_version_that_is_built(whole):
    shared = "driver/src/handler.cpp"
    assert ends(whole["ros1"], "driver") == {
        ("/handled", "std_msgs/String", shared),
        ("/level_old", "std_msgs/Int32", "driver/src/node_old.cpp"),
    }
    assert ends(whole["ros2"], "driver") == {
        ("/handled", "std_msgs/msg/String", shared),
        ("/level_new", "std_msgs/msg/Int32", "driver/src/node_new.cpp"),
    }


def test_classes_of_one_name_in_folders_of_their_version(whole):
    assert ends(whole["ros1"], "camera") == {("/image", "sensor_msgs/Image", "camera/ROS1/camera.cpp")}
    assert ends(whole["ros2"], "camera") == {("/image", "sensor_msgs/msg/Image", "camera/ROS2/camera.cpp")}


def test_two_manifests_of_one_name_are_both_built(whole):
    assert ends(whole["ros1"], "lidar") == {("/scan", "sensor_msgs/LaserScan", "lidar/ros1/src/lidar.cpp")}
    assert ends(whole["ros2"], "lidar") == {("/scan", "sensor_msgs/msg/LaserScan", "lidar/ros2/src/lidar.cpp")}


def test_arms_of_the_preprocessor_in_one_source(whole):
    assert ends(whole["ros1"], "sonar") == {("/range", "sensor_msgs/Range", "sonar/src/sonar.cpp")}
    assert ends(whole["ros2"], "sonar") == {("/range", "sensor_msgs/msg/Range", "sonar/src/sonar.cpp")}
    assert [node.name for node in whole["ros2"].nodes] == ["/camera", "/driver", "/lidar", "/sonar"]
    assert not any(node.conditions for one in whole.values() for node in one.nodes)


def test_a_launch_file_starts_programs_of_its_version(found):
    old = found.launched("driver/old.launch", {})
    assert ends(old, "driver") == ends(found.packages(["driver"])[0], "driver")
    new = found.launched("driver/new.launch.py", {})
    assert ends(new, "driver") == ends(found.packages(["driver"])[1], "driver")


def test_a_program_of_the_other_version_is_said_to_be(found):
    new = found.launched("driver/new.launch.py", {})
    (reason,) = {one.reason for one in new.unresolved if "old_camera_alone" in one.text}
    assert reason.startswith("no build of package camera creates old_camera_alone for this ROS: it is for ROS 1; ")


def test_what_is_left_of_one_version_is_listed_as_of_that_version(found):
    (left,) = found.unstarted(())
    assert left.generation == "ros1"
    assert ends(left, "lidar") == {("/left", "std_msgs/String", "lidar/ros2/src/leftover.cpp")}
