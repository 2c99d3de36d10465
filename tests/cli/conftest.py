"""A small workspace of ROS 2: two launch files, one of which includes the other, and qualities that do not fit."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

NODES = """\
import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import String


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "chatter", qos_profile_sensor_data)


class Listener(Node):
    def __init__(self):
        super().__init__("listener")
        self.subscription = self.create_subscription(String, "chatter", print, 10)


def talk():
    rclpy.init()
    rclpy.spin(Talker())


def listen():
    rclpy.init()
    rclpy.spin(Listener())
"""
ROBOT = """\
<launch>
  <arg name="listening" default="true"/>
  <node pkg="talk" exec="talker"/>
  <node pkg="talk" exec="listener" if="$(var listening)"/>
</launch>
"""
FLEET = '<launch><include file="$(find-pkg-share talk)/launch/robot.launch.xml"/><node pkg="a" exec="b"/></launch>\n'
MANIFEST = """\
<package format="3"><name>talk</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license><depend>std_msgs</depend>
<export><build_type>ament_python</build_type></export></package>
"""
SETUP = (
    "from setuptools import setup\nsetup(name='talk', packages=['talk'], entry_points={'console_scripts': "
    "['talker = talk.nodes:talk', 'listener = talk.nodes:listen']}, data_files=["
    "('share/ament_index/resource_index/packages', ['resource/talk']), ('share/talk', ['package.xml']), "
    "('share/talk/launch', ['launch/robot.launch.xml', 'launch/fleet.launch.xml'])])\n"
)
FILES = {
    "package.xml": MANIFEST,
    "setup.py": SETUP,
    "resource/talk": "",
    "setup.cfg": "[install]\ninstall_scripts=$base/lib/talk\n",
    "talk/__init__.py": "",
    "talk/nodes.py": NODES,
    "launch/robot.launch.xml": ROBOT,
    "launch/fleet.launch.xml": FLEET,
    "test/test.launch.xml": FLEET.replace("robot", "fleet"),
}


@pytest.fixture(scope="session")
def talk() -> Callable[[Path], Path]:
    """Return what writes the workspace into a folder and returns that."""

    def write(root: Path) -> Path:
        for path, text in FILES.items():
            place = root / "talk" / path
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text)
        return root

    return write


@pytest.fixture
def talking(tmp_path: Path, talk: Callable[[Path], Path]) -> Path:
    """Write the workspace into a folder of its own and return it."""
    return talk(tmp_path / "ws")
