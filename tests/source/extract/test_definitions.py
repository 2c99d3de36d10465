"""Two definitions of one type in a workspace, and the code that uses either: what the rule needs to see it."""

import pytest

from roslens.source.extract.configuration.assemble import assemble, targets_started
from roslens.source.extract.facts.launched import Launch
from roslens.source.extract.workspace.workspace_facts import WorkspaceFacts
from roslens.source.rules.graph.definition import found
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import find_workspace
from roslens.store.cache import Cache

ROS2 = '<package format="3"><name>{}</name><version>0.0.1</version><description>a</description><maintainer email="a@b.c">a</maintainer><license>MIT</license><export><build_type>{}</build_type></export></package>'  # noqa: E501
SETUP = """from setuptools import setup
setup(name="{0}", packages=["{0}"], entry_points={{"console_scripts": ["{0} = {0}.node:main"]}})
"""
NODE = """import rclpy
from rclpy.node import Node
from msgs.msg import Speed


def main():
    rclpy.init()
    node = Node("{}")
    node.{}
"""
TALKER = 'create_publisher(Speed, "speed", 10)'
LISTENER = 'create_subscription(Speed, "speed", print, 10)'


def workspace(root, second):
    contents = {
        "one/msgs/package.xml": ROS2.format("msgs", "ament_cmake"),
        "one/msgs/msg/Speed.msg": "float64 value\n",
        "two/msgs/package.xml": ROS2.format("msgs", "ament_cmake"),
        "two/msgs/msg/Speed.msg": second,
    }
    for folder, name, body in (("one", "talker", TALKER), ("two", "listener", LISTENER)):
        contents[f"{folder}/{name}/package.xml"] = ROS2.format(name, "ament_python")
        contents[f"{folder}/{name}/setup.py"] = SETUP.format(name)
        contents[f"{folder}/{name}/setup.cfg"] = f"[install]\ninstall_scripts=$base/lib/{name}\n"
        contents[f"{folder}/{name}/{name}/__init__.py"] = ""
        contents[f"{folder}/{name}/{name}/node.py"] = NODE.format(name, body)
    for path, content in contents.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(content)


@pytest.mark.parametrize(("second", "findings"), [("float32 value\n", 1), ("float64 value\n", 0)])
def test_ends_that_use_different_definitions_of_a_type(tmp_path, second, findings):
    workspace(tmp_path, second)
    with Cache.open(None) as cache:
        settings = SourceSettings()
        units = WorkspaceFacts(find_workspace([tmp_path], settings.workspace), settings, cache=cache, now_s=1e9, jobs=1)
        started = [one for name in ("talker", "listener") for one in targets_started(name, units, "ros2").nodes]
        whole = assemble(Launch("ros2", tuple(started)), units, title="both", by_launch=False)
    sums = {end.endpoint.hash for node in whole.nodes for end in node.endpoints if end.endpoint.name == "/speed"}
    assert len(sums) == 1 + findings
    assert all(one.startswith("RIHS01_") for one in sums)
    told = list(found(whole, Surroundings()))
    assert len(told) == findings
    assert all("different definitions of msgs/msg/Speed" in one.message for one in told)
