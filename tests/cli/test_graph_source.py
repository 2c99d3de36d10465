from pathlib import Path

import pytest

from roslens.cli.graph.graph_source import GraphSource, arguments_of
from roslens.model.errors import UsageError
from roslens.source.settings import SourceSettings, WorkspaceSettings

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "workspace")


def source(path: str = EXAMPLE) -> GraphSource:
    return GraphSource(path, SourceSettings(), "roslens.toml", {})


def test_arguments_are_names_and_values():
    assert arguments_of(["a:=b", "c:=", "d:=e:=f"]) == {"a": "b", "c": "", "d": "e:=f"}
    with pytest.raises(UsageError, match="name:=value"):
        arguments_of([":=b"])


def test_launch_files_are_named_by_package():
    with source() as found:
        assert "rover_bringup/rover.launch.py" in list(found.launch_files())


def test_a_launch_file_may_be_named_by_package_or_by_path():
    path = "src/rover/rover_bringup/launch/rover.launch.py"
    with source() as found:
        titles = [
            found.launched(name, {}).title
            for name in (
                "rover_bringup/rover.launch.py",
                "rover_bringup/launch/rover.launch.py",
                path,
                f"{EXAMPLE}/{path}",
            )
        ]
        assert titles == [path] * 4
        assert found.launched(path, {"device": "/dev/x"}).title == f"{path} device:=/dev/x"


def test_what_is_outside_of_the_workspace_is_refused(tmp_path):
    outside = tmp_path / "a.launch.py"
    outside.write_text("")
    with source() as found, pytest.raises(UsageError, match="outside of the workspace"):
        found.launched(str(outside), {})


@pytest.mark.parametrize(
    ("name", "content", "generation"),
    [
        ("a.launch", '<launch><node pkg="a" type="b" name="c"/></launch>', "ros1"),
        ("a.launch", '<launch><node pkg="a" exec="b"/></launch>', "ros2"),
        ("a.launch.xml", '<launch><node pkg="a" exec="b"/></launch>', "ros2"),
        ("a.launch.xml", '<launch><node pkg="a" type="b" name="c"/></launch>', "ros1"),
        ("a.launch.yaml", "launch: []", "ros2"),
        ("a.launch.py", "", "ros2"),
    ],
)
def test_the_generation_of_a_launch_file_is_told_by_its_content(tmp_path, name, content, generation):
    (tmp_path / name).write_text(content)
    with source(str(tmp_path)) as found:
        assert found.launched(name, {}).generation == generation


def test_the_environment_of_the_robot_is_that_of_the_settings(tmp_path):
    (tmp_path / "package.xml").write_text("<package><name>a</name></package>")
    launch = tmp_path / "a.launch"
    launch.write_text('<launch><node pkg="a" type="b" name="$(env ROBOT)" if="$(optenv THERE 0)"/></launch>')
    settings = SourceSettings(workspace=WorkspaceSettings(environment={"ROBOT": "r1", "THERE": "1"}))
    with GraphSource(str(tmp_path), settings, "roslens.toml", {}) as found:
        assert [node.name for node in found.launched(str(launch), {}).nodes] == ["/r1"]


NODE_OF_ROS2 = """
#include <rclcpp/rclcpp.hpp>
int main(int argc, char ** argv) { rclcpp::init(argc, argv); auto node = std::make_shared<rclcpp::Node>("a"); }
"""


@pytest.mark.parametrize(
    ("manifest", "cmake", "generation"),
    [
        ("<depend>rclcpp</depend>", "", "ros2"),
        ("<buildtool_depend>ament_cmake</buildtool_depend>", "", "ros2"),
        ("", "find_package(ament_cmake REQUIRED)", "ros2"),
        ("<buildtool_depend>catkin</buildtool_depend>", "find_package(rclcpp)", "ros1"),
        ("", "find_package(catkin REQUIRED COMPONENTS roscpp)", "ros1"),
    ],
)
def test_a_package_without_a_build_type_is_of_the_generation_that_it_depends_on(tmp_path, manifest, cmake, generation):
    (tmp_path / "package.xml").write_text(f'<package format="3"><name>a</name>{manifest}</package>')
    build = "add_executable(a a.cpp)\ninstall(TARGETS a DESTINATION lib/a)\n"
    (tmp_path / "CMakeLists.txt").write_text(f"project(a)\n{cmake}\n{build}")
    (tmp_path / "a.cpp").write_text(NODE_OF_ROS2)
    with source(str(tmp_path)) as found:
        assert [one.generation for one in found.packages([])] == [generation]
