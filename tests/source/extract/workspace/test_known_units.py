"""What is known of units is what evaluating them again comes to, whatever was edited meanwhile."""

import tempfile
from contextlib import closing
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.extract.units import finished_unit
from roslens.source.extract.workspace.extraction import extract
from roslens.source.extract.workspace.workspace_facts import WorkspaceFacts
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import find_workspace
from roslens.store.cache import Cache

MANIFEST = (
    '<package format="3"><name>{name}</name><version>1.0.0</version><description>d</description>'
    "<maintainer email='a@example.org'>a</maintainer><license>MIT</license>{needs}"
    "<export><build_type>ament_cmake</build_type></export></package>"
)
BUILD = (
    "cmake_minimum_required(VERSION 3.8)\nproject({name})\nfind_package(ament_cmake REQUIRED)\n{made}ament_package()\n"
)
HEADER = """#pragma once
#include <rclcpp/rclcpp.hpp>
#define STATE_TOPIC "state"
namespace base {
class Node : public rclcpp::Node {
 public:
  Node(const std::string & name);
  virtual std::string topic() { return "common"; }
};
}
"""
BASE = """#include "base/node.hpp"
#include <std_msgs/msg/string.hpp>
namespace base {
Node::Node(const std::string & name) : rclcpp::Node(name) {
  pub_ = create_publisher<std_msgs::msg::String>(STATE_TOPIC, 10);
}
}
"""
ARM = """#include "base/node.hpp"
#include "words.hpp"
#include <std_msgs/msg/string.hpp>
class Arm : public base::Node {
 public:
  Arm() : base::Node("arm") {
    sub_ = create_subscription<std_msgs::msg::String>(arm_topic(), 10, [this](const std_msgs::msg::String &) {});
  }
};
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Arm>());
}
"""
WORDS = '#pragma once\nstd::string arm_topic() { return "arm/goal"; }\n'
GRIPPER = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto node = rclcpp::Node::make_shared("gripper");
  auto pub = node->create_publisher<std_msgs::msg::String>("grip", 10);
  rclcpp::spin(node);
}
"""
EYE = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from eye.names import LOOK

class Eye(Node):
    def __init__(self):
        super().__init__('eye')
        self.create_publisher(String, LOOK, 10)

def main():
    rclpy.init()
    rclpy.spin(Eye())
"""
SETUP = (
    "from setuptools import setup\nsetup(name='eye', packages=['eye'],"
    " entry_points={'console_scripts': ['look = eye.look:main']})\n"
)
FILES = {
    "base/package.xml": MANIFEST.format(name="base", needs="<depend>rclcpp</depend>"),
    "base/CMakeLists.txt": BUILD.format(name="base", made="add_library(base src/node.cpp)\n"),
    "base/include/base/node.hpp": HEADER,
    "base/src/node.cpp": BASE,
    "arm/package.xml": MANIFEST.format(name="arm", needs="<depend>rclcpp</depend><depend>base</depend>"),
    "arm/CMakeLists.txt": BUILD.format(
        name="arm", made="add_executable(arm src/arm.cpp)\nadd_executable(gripper src/gripper.cpp)\n"
    ),
    "arm/src/arm.cpp": ARM,
    "arm/src/words.hpp": WORDS,
    "arm/src/gripper.cpp": GRIPPER,
    "eye/package.xml": MANIFEST.format(name="eye", needs="<depend>rclpy</depend>").replace(
        "ament_cmake", "ament_python"
    ),
    "eye/setup.py": SETUP,
    "eye/eye/__init__.py": "",
    "eye/eye/names.py": "LOOK = 'look'\n",
    "eye/eye/look.py": EYE,
}
PROGRAMS = (("arm/src/arm.cpp", ""), ("arm/src/gripper.cpp", ""), ("eye/eye/look.py", "main"))
WRITTEN = {
    "comment": ("arm/src/arm.cpp", ARM + "// note\n"),
    "moved": ("arm/src/arm.cpp", "\n\n" + ARM),
    "base method": ("base/src/node.cpp", BASE.replace("STATE_TOPIC", '"status"')),
    "base macro": ("base/include/base/node.hpp", HEADER.replace('"state"', '"condition"')),
    "base gone": ("base/include/base/node.hpp", HEADER.replace("class Node : public rclcpp::Node", "class Node")),
    "base renamed": ("base/include/base/node.hpp", HEADER.replace("namespace base", "namespace other")),
    "included": ("arm/src/words.hpp", WORDS.replace("arm/goal", "arm/target")),
    "no longer included": ("arm/src/arm.cpp", ARM.replace('#include "words.hpp"\n', "")),
    "shadowing header": ("arm/src/base/node.hpp", HEADER.replace('"state"', '"own_state"')),
    "shadowing function": ("arm/src/more.cpp", 'std::string arm_topic() { return "elsewhere"; }\n'),
    "shadowing class": ("arm/src/other.hpp", "namespace base { class Node { int x; }; }\n"),
    "shadowing module": ("eye/eye/eye/names.py", "LOOK = 'stare'\n"),
    "module": ("eye/eye/names.py", "# where it looks\nLOOK = 'watch'\n"),
    "changed from outside": ("eye/eye/other.py", "from eye.look import Eye\n\ndef change():\n    Eye.topic = 'gaze'\n"),
    "manifest": ("arm/package.xml", FILES["arm/package.xml"].replace("<depend>base</depend>", "")),
    "build": ("arm/CMakeLists.txt", FILES["arm/CMakeLists.txt"].replace("gripper.cpp", "gripper.cpp src/more.cpp")),
    "gripper": ("arm/src/gripper.cpp", GRIPPER.replace('"grip"', '"hold"')),
}  # fmt: skip
EDITS = st.lists(
    st.one_of(
        st.sampled_from(sorted(WRITTEN)),
        st.sampled_from(sorted(FILES)).map(lambda path: f"remove {path}"),
        st.sampled_from(sorted(FILES)).map(lambda path: f"restore {path}"),
    ),
    min_size=1,
    max_size=5,
)


def write(root: Path, path: str, text: str) -> None:
    place = root / path
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text(text)


def edit(root: Path, what: str) -> None:
    verb, _, path = what.partition(" ")
    if what in WRITTEN:
        write(root, *WRITTEN[what])
    elif verb == "remove":
        (root / path).unlink(missing_ok=True)
    else:
        write(root, path, FILES[path])


def known(root: Path, cache: Cache) -> tuple[object, ...]:
    """Return what is known of all units of a workspace, and of those that are started, in two looks."""
    chosen = SourceSettings()
    whole = extract([root], chosen, cache=cache, now_s=1e9, jobs=1)
    facts = WorkspaceFacts(find_workspace([root], chosen.workspace), chosen, cache=cache, now_s=1e9, jobs=1).of("ros2")
    started = [facts.program(path, function) for path, function in PROGRAMS]
    classes = [facts.of_class(name) for name in ("Arm", "eye/eye/look.py:Eye")]
    facts.keep()
    return whole.nodes, whole.unresolved, [list(one) for one in (*started, *classes)], whole.failures


@settings(max_examples=40, deadline=None)
@given(EDITS)
def test_what_is_known_after_edits_is_what_a_fresh_look_says(edits):
    with tempfile.TemporaryDirectory() as folder:
        root, kept = Path(folder, "ws"), Path(folder, "cache.sqlite")
        for path, text in FILES.items():
            write(root, path, text)
        for what in ("", *edits):
            if what:
                edit(root, what)
            with Cache.open(kept) as cache, Cache.open(None) as nothing:
                assert known(root, cache) == known(root, nothing), what


@pytest.fixture
def workspace(tmp_path):
    root = tmp_path / "ws"
    for path, text in FILES.items():
        write(root, path, text)
    return root


def evaluated(root: Path, kept: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return the files whose units are evaluated in a look at a workspace."""
    found: list[str] = []
    real = finished_unit._made

    def noted(ctx, run):
        found.append(ctx.emitter.node.path)
        return real(ctx, run)

    with monkeypatch.context() as patched, Cache.open(kept) as cache:
        patched.setattr(finished_unit, "_made", noted)
        known(root, cache)
    return sorted(set(found))


def test_only_units_that_know_a_changed_file_are_evaluated_again(workspace, tmp_path, monkeypatch):
    kept = tmp_path / "cache.sqlite"
    assert {"arm/src/arm.cpp", "arm/src/gripper.cpp", "eye/eye/look.py"} <= set(evaluated(workspace, kept, monkeypatch))
    assert evaluated(workspace, kept, monkeypatch) == []
    edit(workspace, "comment")
    assert evaluated(workspace, kept, monkeypatch) == []
    edit(workspace, "gripper")
    assert evaluated(workspace, kept, monkeypatch) == ["arm/src/gripper.cpp"]
    edit(workspace, "base method")
    again = evaluated(workspace, kept, monkeypatch)
    assert "arm/src/arm.cpp" in again
    assert not {"arm/src/gripper.cpp", "eye/eye/look.py"} & set(again)
    edit(workspace, "module")
    assert set(evaluated(workspace, kept, monkeypatch)) <= {"eye/eye/look.py", "eye/eye/names.py"}


def test_a_damaged_unit_is_evaluated_again(workspace, tmp_path):
    kept = tmp_path / "cache.sqlite"
    with Cache.open(kept) as cache:
        first = known(workspace, cache)
    import sqlite3

    with closing(sqlite3.connect(kept)) as connection, connection:
        connection.execute(
            "UPDATE blob SET content = ? WHERE number IN (SELECT number FROM facts WHERE key LIKE 'graph:%')",
            (b"\x93",),
        )
    connection.close()
    with Cache.open(kept) as cache:
        assert known(workspace, cache) == first
