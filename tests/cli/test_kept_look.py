"""What a check says with what it kept is what one says that keeps nothing, whatever was edited in between."""

import sqlite3
import tempfile
from contextlib import closing
from pathlib import Path

import pytest
from cli.said_again import fresh, said
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.cli.graph.kept_look import KeptLook

MANIFEST = (
    '<package format="3"><name>robot</name><version>1.0.0</version><description>d</description>'
    "<maintainer email='a@example.org'>a</maintainer><license>MIT</license><depend>rclcpp</depend>"
    "<depend>rclpy</depend><depend>robot_msgs</depend><export><build_type>ament_cmake</build_type></export></package>"
)
BUILD = """cmake_minimum_required(VERSION 3.8)
project(robot)
find_package(ament_cmake REQUIRED)
add_executable(drive src/drive.cpp)
install(TARGETS drive DESTINATION lib/robot)
install(PROGRAMS scripts/look.py DESTINATION lib/robot)
install(DIRECTORY launch config DESTINATION share/robot)
ament_package()
"""
DRIVE = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Drive : public rclcpp::Node {
 public:
  Drive() : Node("drive") {
    declare_parameter("speed", 1.0);
    sub_ = create_subscription<std_msgs::msg::String>("goal", 10, [](const std_msgs::msg::String &) {});
    own_pub_ = create_publisher<robot::msg::State>("inner_state", 10);
    own_sub_ = create_subscription<robot::msg::State>("inner_state", 10, [](const robot::msg::State &) {});
  }
};
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Drive>());
}
"""
LOOK = """import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32

class Look(Node):
    def __init__(self):
        super().__init__('look')
        self.pub = self.create_publisher(Int32, 'goal', 10)

def main():
    rclpy.init()
    rclpy.spin(Look())

if __name__ == '__main__':
    main()
"""
LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node
from robot.names import NAME

def generate_launch_description():
    return LaunchDescription([
        Node(package='robot', executable='drive', name=NAME, parameters=[{'sped': 1.0}]),
        Node(package='robot', executable='look.py'),
    ])
"""
PATHS = {
    "manifest": "package.xml",
    "build": "CMakeLists.txt",
    "drive": "src/drive.cpp",
    "look": "scripts/look.py",
    "launch": "launch/robot.launch.py",
    "names": "robot/names.py",
    "test": "test/test_drive.cpp",
    "other": "src/other.cpp",
}
FILES = {
    "manifest": MANIFEST,
    "build": BUILD,
    "drive": DRIVE,
    "look": LOOK,
    "launch": LAUNCH,
    "names": "NAME = 'drive'\n",
    "test": "int tested() { return 1; }\n",
    "other": "int other() { return 1; }\n",
}
UNSEEN = {
    "a marker where nothing is found": ("look", LOOK.replace("'goal', 10)", "'goal', 10)  # NOLINT(graph.type)")),
    "a comment": ("drive", DRIVE + "// a word\n"),
    "a comment of Python": ("look", LOOK.replace("10)", "10)  # ten")),
    "a comment of a test": ("test", FILES["test"] + "// a word\n"),
    "code of a test": ("test", "int tested() { return 2; }\n"),
}
SEEN = {
    "a line": ("drive", "// a line\n" + DRIVE),
    "code": ("drive", DRIVE.replace('"goal"', '"other"')),
    "a type": ("look", LOOK.replace("Int32", "String")),
    "a finding set aside": ("drive", DRIVE.replace("String &) {});", "String &) {});  // NOLINT(graph.type)")),
    "a name in a comment": ("other", FILES["other"] + "// reads inner_state\n"),
    "a name in a test": ("test", FILES["test"] + "// inner_state\n"),
    "a helper of the launch file": ("names", "NAME = 'other'\n"),
    "a comment of a helper": ("names", "NAME = 'drive'  # a word\n"),
    "a launch file": ("launch", LAUNCH.replace("sped", "speed")),
    "a build": ("build", BUILD.replace("scripts/look.py", "")),
    "a manifest": ("manifest", MANIFEST.replace("<depend>rclpy</depend>", "")),
    "no test": ("test", None),
}
EDITS = UNSEEN | SEEN


def write(root: Path, name: str, text: str | None) -> None:
    place = root / "robot" / PATHS[name]
    place.parent.mkdir(parents=True, exist_ok=True)
    if text is None:
        place.unlink(missing_ok=True)
    else:
        place.write_text(text)


def restore(root: Path) -> None:
    for name, text in FILES.items():
        write(root, name, text)


@pytest.fixture
def workspace(tmp_path):
    root = tmp_path / "ws"
    root.mkdir()
    restore(root)
    return root


@pytest.fixture
def looks(monkeypatch):
    """Whether each look was known."""
    found: list[bool] = []
    known = KeptLook.known

    def noted(self):
        sight = known(self)
        found.append(sight is not None)
        return sight

    monkeypatch.setattr(KeptLook, "known", noted)
    return found


@settings(max_examples=6, deadline=None)
@given(st.lists(st.one_of(st.sampled_from(sorted(EDITS)), st.just("restore")), min_size=1, max_size=4))
def test_what_is_kept_changes_nothing(edits):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder, "ws")
        root.mkdir()
        restore(root)
        said(root)
        for edit in edits:
            if edit == "restore":
                restore(root)
            else:
                write(root, *EDITS[edit])
            assert said(root) == fresh(root), edit


@pytest.mark.parametrize("edit", sorted(UNSEEN))
def test_an_edit_that_no_graph_sees_leaves_the_look_as_it_was(workspace, looks, edit):
    before = said(workspace)
    write(workspace, *EDITS[edit])
    after = said(workspace)
    assert looks == [False, True]
    assert after == fresh(workspace)
    for one in (before, after):
        assert {"graph.type", "graph.private_data"} <= {found["rule"] for found in all_findings(one)}


def all_findings(report):
    if isinstance(report, dict):
        if "rule" in report and "message" in report:
            yield report
        for one in report.values():
            yield from all_findings(one)
    elif isinstance(report, list):
        for one in report:
            yield from all_findings(one)


@pytest.mark.parametrize("edit", sorted(SEEN))
def test_an_edit_that_a_graph_may_see_is_looked_at(workspace, looks, edit):
    said(workspace)
    write(workspace, *EDITS[edit])
    after = said(workspace)
    assert looks == [False, False]
    assert after == fresh(workspace)


def test_a_name_that_another_file_mentions_anyway_is_not_seen(workspace, looks):
    write(workspace, "other", FILES["other"] + "// inner_state\n")
    said(workspace)
    write(workspace, "test", FILES["test"] + "// inner_state\n")
    assert said(workspace) == fresh(workspace)
    assert looks[:2] == [False, True]


def test_other_settings_are_another_look(workspace, looks):
    said(workspace)
    (workspace / "roslens.toml").write_text('[graph.configurations.main]\nlaunch = "robot/robot.launch.py"\n')
    said(workspace)
    assert looks == [False, False]


def test_a_damaged_look_is_made_again(workspace, looks):
    said(workspace)
    with closing(sqlite3.connect(workspace / ".roslens" / "cache.sqlite")) as connection, connection:
        changed = connection.execute(
            "UPDATE blob SET content = x'c1' WHERE number IN (SELECT number FROM facts WHERE key LIKE 'graph:look:%')"
        ).rowcount
    assert changed == 1
    write(workspace, *UNSEEN["a comment of a test"])
    assert said(workspace) == fresh(workspace)
    assert looks == [False, False]
