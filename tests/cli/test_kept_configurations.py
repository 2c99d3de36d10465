"""What a check says of launch files with what it kept is what one says that keeps nothing, after every kind of edit."""

from pathlib import Path

import pytest
from cli.said_again import fresh, said

import roslens
from roslens.cli.graph.graph_source import GraphSource
from roslens.source.keys import analyser_version

NODE = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Drive : public rclcpp::Node {
 public:
  Drive() : Node("drive") {
    declare_parameter("speed", 1.0);
    sub_ = create_subscription<std_msgs::msg::String>("goal", 10, [](const std_msgs::msg::String &) {});
  }
};
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Drive>());
}
"""
SECOND = NODE.replace("Drive", "Arm").replace("drive", "arm").replace("speed", "reach").replace('"goal"', '"target"')
BUILD = """cmake_minimum_required(VERSION 3.8)
project(robot)
find_package(ament_cmake REQUIRED)
add_executable(drive src/drive.cpp)
add_executable(arm src/arm.cpp)
install(TARGETS drive arm DESTINATION lib/robot)
install(DIRECTORY launch config DESTINATION share/robot)
ament_package()
"""
ROBOT = """<launch>
  <arg name="speed" default="1.0"/>
  <node pkg="robot" exec="drive">
    <param from="$(find-pkg-share robot)/config/drive.yaml"/>
    <param name="sped" value="$(var speed)"/>
  </node>
</launch>
"""
ARM = '<launch>\n  <node pkg="robot" exec="arm"><param name="rech" value="1.0"/></node>\n</launch>\n'
START = """from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

def generate_launch_description():
    path = PathJoinSubstitution([FindPackageShare('robot'), 'launch', 'robot.launch.xml'])
    return LaunchDescription([
        IncludeLaunchDescription(AnyLaunchDescriptionSource(path)),
        Node(package='robot', executable='arm'),
    ])
"""
PARAMETERS = "drive:\n  ros__parameters:\n    speed: 2.0\n"


def manifest(name: str) -> str:
    return (
        f'<package format="3"><name>{name}</name><version>1.0.0</version><description>d</description>'
        "<maintainer email='a@example.org'>a</maintainer><license>MIT</license><depend>rclcpp</depend>"
        "<depend>std_msgs</depend><export><build_type>ament_cmake</build_type></export></package>"
    )


FILES = {
    "robot/package.xml": manifest("robot"),
    "robot/CMakeLists.txt": BUILD,
    "robot/src/drive.cpp": NODE,
    "robot/src/arm.cpp": SECOND,
    "robot/launch/robot.launch.xml": ROBOT,
    "robot/launch/arm.launch.xml": ARM,
    "robot/config/drive.yaml": PARAMETERS,
    "bringup/package.xml": manifest("bringup"),
    "bringup/CMakeLists.txt": "project(bringup)\nfind_package(ament_cmake REQUIRED)\nament_package()\n",
    "bringup/launch/start.launch.py": START,
}
EDITS = {
    "a comment at the end of parameters": {"robot/config/drive.yaml": PARAMETERS + "# a word\n"},
    "a value of a parameter": {"robot/config/drive.yaml": PARAMETERS.replace("2.0", "fast")},
    "another parameter": {"robot/config/drive.yaml": PARAMETERS + "    nothing: 1\n"},
    "parameters gone": {"robot/config/drive.yaml": None},
    "a line at the top of a launch file": {"bringup/launch/start.launch.py": "# a word\n" + START},
    "an argument": {"robot/launch/robot.launch.xml": ROBOT.replace("</launch>", '  <arg name="more"/>\n</launch>')},
    "a default of an argument": {"robot/launch/robot.launch.xml": ROBOT.replace('"1.0"', '"fast"')},
    "a variable": {"robot/launch/robot.launch.xml": ROBOT.replace("$(var speed)", "$(env ROS_DISTRO)")},
    "a target of an include": {"bringup/launch/start.launch.py": START.replace("robot.launch.xml", "arm.launch.xml")},
    "no target of an include": {"bringup/launch/start.launch.py": START.replace("robot.launch.xml", "none.launch.xml")},
    "a comment that sets aside": {"robot/launch/arm.launch.xml": ARM.replace("/></node>", "/></node><!-- NOLINT -->")},
    "another launch file": {"bringup/launch/again.launch.xml": ARM},
    "a launch file that breaks": {"robot/launch/robot.launch.xml": ROBOT.replace("</node>", "")},
    "a package of another name": {"robot/package.xml": manifest("machine")},
    "a file moved to another package": {
        "robot/launch/robot.launch.xml": None,
        "bringup/launch/robot.launch.xml": ROBOT,
    },
    "a build that installs less": {"robot/CMakeLists.txt": BUILD.replace("TARGETS drive arm", "TARGETS drive")},
    "a build that reads parameters": {
        "robot/CMakeLists.txt": "file(STRINGS config/drive.yaml names REGEX drive)\n" + BUILD,
        "robot/config/drive.yaml": "# drive\n" + PARAMETERS,
    },
    "code": {"robot/src/drive.cpp": NODE.replace('"speed"', '"sped"')},
    "a line of code": {"robot/src/drive.cpp": "// a word\n" + NODE},
}


def write(root: Path, files: dict[str, str | None]) -> None:
    for path, text in files.items():
        place = root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        if text is None:
            place.unlink(missing_ok=True)
        else:
            place.write_text(text)


def restore(root: Path) -> None:
    for path in [*root.rglob("launch/*")]:
        path.unlink()
    write(root, FILES)


@pytest.fixture
def workspace(tmp_path):
    root = tmp_path / "ws"
    root.mkdir()
    restore(root)
    return root


@pytest.fixture
def launched(monkeypatch):
    """The launch files of which configurations were assembled."""
    found: list[str] = []
    assemble = GraphSource.launched

    def noted(self, launch, arguments):
        found.append(launch.rpartition("/")[2])
        return assemble(self, launch, arguments)

    monkeypatch.setattr(GraphSource, "launched", noted)
    return found


@pytest.mark.parametrize("edit", sorted(EDITS))
def test_after_an_edit_the_same_is_said_as_by_a_fresh_look(workspace, edit):
    before = said(workspace)
    write(workspace, EDITS[edit])
    assert said(workspace) == fresh(workspace)
    restore(workspace)
    assert said(workspace) == before


def test_after_one_edit_upon_another_the_same_is_said_as_by_a_fresh_look(workspace):
    said(workspace)
    for edit in EDITS:
        write(workspace, EDITS[edit])
        assert said(workspace) == fresh(workspace), edit


def test_only_what_reads_a_file_is_assembled_again(workspace, launched):
    rules = {finding["rule"] for finding in said(workspace)["findings"]}
    assert "graph.parameter_undeclared" in rules
    assert launched == ["start.launch.py", "arm.launch.xml"]
    launched.clear()
    write(workspace, {"robot/launch/arm.launch.xml": ARM.replace("rech", "reach")})
    assert said(workspace) == fresh(workspace)
    assert launched == ["arm.launch.xml", "start.launch.py", "arm.launch.xml"]
    launched.clear()
    write(workspace, EDITS["a comment at the end of parameters"])
    said(workspace)
    assert launched == []
    write(workspace, EDITS["a value of a parameter"])
    said(workspace)
    assert launched == ["start.launch.py"]


def test_another_distribution_in_the_environment_is_seen(workspace, monkeypatch):
    write(workspace, EDITS["a variable"])
    monkeypatch.setenv("ROS_DISTRO", "humble")
    first = said(workspace)
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    assert said(workspace) == fresh(workspace)
    monkeypatch.setenv("ROS_DISTRO", "humble")
    assert said(workspace) == first


def test_another_roslens_looks_again(workspace, monkeypatch, launched):
    said(workspace)
    monkeypatch.setattr(roslens, "__version__", "99.0")
    analyser_version.cache_clear()
    launched.clear()
    try:
        assert said(workspace) == fresh(workspace)
        assert len(launched) == 4
    finally:
        analyser_version.cache_clear()
