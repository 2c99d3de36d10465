"""Modules of the workspace that launch files import."""

import pytest

from roslens.source.extract.launch.launch_ros2 import evaluate_ros2
from roslens.source.extract.launch.ros2_names import full_name

HEAD = """
import os, sys
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import OpaqueFunction
from launch_ros.actions import Node
"""
PATH = "sys.path.append(os.path.join(get_package_share_directory('robot'), 'launch'))\n"
SHARED = """
from launch_ros.actions import Node
NAMES = ['a', 'b']
def nodes(names):
    return [driver(name) for name in names]
def driver(name):
    return Node(package='p', executable='e', name=name)
def setup(context, *args, **kwargs):
    return nodes(NAMES)
"""


class Files:
    """Files that are written in the test."""

    def __init__(self, **files):
        self._files = {name.replace("__", "/").replace("_py", ".py"): text.encode() for name, text in files.items()}

    def package(self, name):
        return name if any(path.startswith(f"{name}/") for path in self._files) else None

    def content(self, path):
        return self._files.get(path)


def launched(text, **more):
    files = Files(robot__examples__one_py=text, robot__launch__shared_py=SHARED, **more)
    return evaluate_ros2("robot/examples/one.py", files)


def entry(body, before=""):
    return f"{HEAD}{before}\ndef generate_launch_description():\n    return LaunchDescription({body})\n"


@pytest.mark.parametrize(
    ("before", "body"),
    [
        (f"{PATH}import shared", "shared.nodes(shared.NAMES)"),
        (f"{PATH}import shared as other", "other.nodes(other.NAMES)"),
        (f"{PATH}from shared import nodes, NAMES as ALL", "nodes(ALL)"),
        (f"{PATH}from shared import *", "nodes(NAMES)"),
        (f"{PATH}import shared", "[OpaqueFunction(function=shared.setup)]"),
    ],
)
def test_what_a_module_defines(before, body):
    found = launched(entry(body, before))
    assert [str(full_name(one)) for one in found.nodes] == ["/a", "/b"]
    assert {one.evidence.path for one in found.nodes} == {"robot/launch/shared.py"}
    assert found.unresolved == ()


@pytest.mark.parametrize("before", ["import shared", f"{PATH}import missing as shared"])
def test_a_module_that_is_not_found(before):
    found = launched(entry("shared.nodes(shared.NAMES)", before))
    assert found.nodes == ()
    assert found.unresolved


def test_modules_that_import_each_other():
    other = "import sys\nsys.path.append('.')\nimport one\nX = one.HERE\n"
    text = entry("[Node(package='p', executable='e', name=HERE)]", "sys.path.append('.')\nimport other\nHERE = 'here'")
    assert [str(full_name(one)) for one in launched(text, robot__examples__other_py=other).nodes] == ["/here"]


def test_a_module_that_is_no_python():
    text = entry("broken.nodes()", "sys.path.append('.')\nimport broken")
    assert launched(text, robot__examples__broken_py="def (").unresolved


@pytest.mark.parametrize(
    ("before", "body"),
    [
        ("from robot.shared import nodes, NAMES", "nodes(NAMES)"),
        ("from robot import shared", "shared.nodes(shared.NAMES)"),
    ],
)
def test_a_module_of_a_package(before, body):
    found = launched(entry(body, before), robot__robot__shared_py=SHARED)
    assert [str(full_name(one)) for one in found.nodes] == ["/a", "/b"]
    assert {one.evidence.path for one in found.nodes} == {"robot/robot/shared.py"}


CLASSES = """
from enum import Enum
class Base:
    NAME = 'arm'
class Settings(Base):
    TOPIC: str = '/scan'
    def __init__(self):
        self.other = 'x'
class Mode(Enum):
    NAME = 'fast'
"""


def named(name, settings=CLASSES):
    text = entry(f"[Node(package='p', executable='e', name={name})]", f"{PATH}from settings import *\n")
    (node,) = launched(text, robot__launch__settings_py=settings).nodes
    return str(node.name)


def test_what_is_assigned_in_a_class():
    assert named("Settings.TOPIC") == "/scan"
    assert named("Settings.NAME") == "arm"


def test_what_a_constructor_sets():
    assert named("Settings().other") == "x"


@pytest.mark.parametrize(("name", "class_"), [("Settings.missing", "Settings"), ("Mode.NAME", "Mode")])
def test_a_class_is_of_the_file_that_defines_it(name, class_):
    assert named(name) == f"{{class {class_} of robot/launch/settings.py}}"
