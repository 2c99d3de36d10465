"""Two monitors of one system, both of which publish what they find: each sees the system and not the other."""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
import time
from contextlib import ExitStack
from pathlib import Path

import pytest
import yaml
from ros2_domain import own_domain
from running_node import running

from testbed import robot_ros1, robot_ros2

pytestmark = pytest.mark.real

ROSLENS = Path(sys.executable).parent / "roslens"
REFERENCE = """
kind: reference
name: demo
defaults: {grace: 15 s}
constraints:
  - {topic: /chatter, expected: always}
  - {node: /talker, expected: always}
"""
TALKER1 = """
import rospy
from std_msgs.msg import String
rospy.init_node("talker")
publisher, rate = rospy.Publisher("/chatter", String, queue_size=10), rospy.Rate(20)
while not rospy.is_shutdown():
    publisher.publish("hello")
    rate.sleep()
"""
TALKER2 = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("talker")
publisher = node.create_publisher(String, "/chatter", 10)
node.create_timer(0.05, lambda: publisher.publish(String(data="hello")))
rclpy.spin(node)
"""


def watch_twice(generation, environment, folder):
    """Watch with two monitors at once, which both publish; return of each its lines and the names of nodes it saw."""
    document = folder / "demo.yaml"
    document.write_text(REFERENCE)
    started = []
    for number in range(2):
        out, graph = folder / f"{number}.json", folder / f"{number}.yaml"
        words = ["watch", f"--{generation}", "--reference", str(document), "--diagnostics", "--for", "15 s"]
        command = [str(ROSLENS), *words, "--format", "json", "-o", str(out), "--graph-out", str(graph)]
        started.append((subprocess.Popen(command, env=environment), out, graph))
    found = []
    for process, out, graph in started:
        code = process.wait(90)
        lines = [json.loads(line) for line in out.read_text().splitlines()]
        assert code == 0, [one for one in lines if one["is"] != "event"]
        found.append((lines, {node["name"] for node in yaml.safe_load(graph.read_text())["nodes"]}))
    return found


def judged(found, besides):
    for lines, nodes in found:
        states = {one["entity"]: one["state"] for one in lines if one["is"] == "verdict"}
        assert {"topic:/chatter": "ok", "node:/talker": "ok"}.items() <= states.items()
        assert nodes - besides == {"/talker"}
        reported = [one["entity"] for one in lines if one["is"] == "event" and "roslens" in one["entity"]]
        assert reported == []


@pytest.mark.nightly
@pytest.mark.timeout(150)
@pytest.mark.skipif(not shutil.which("roscore"), reason="roscore is not installed")
def test_two_monitors_of_ros1(tmp_path):
    if reason := robot_ros1.why_not():
        pytest.skip(reason)
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    master = {"ROS_MASTER_URI": f"http://127.0.0.1:{port}", "ROS_IP": "127.0.0.1"}
    folders = {"ROS_HOME": str(tmp_path / "home"), "ROS_LOG_DIR": str(tmp_path / "log")}
    environment = {**os.environ, **master, **folders}
    with ExitStack() as stack:
        stack.enter_context(running("roscore", "-p", str(port), environment=environment))
        answered(port)
        stack.enter_context(running(robot_ros1.PYTHON, "-c", TALKER1, environment=environment))
        found = watch_twice("ros1", environment, tmp_path)
    judged(found, {"/rosout"})


@pytest.mark.timeout(150)
def test_two_monitors_of_ros2(tmp_path):
    if reason := robot_ros2.why_not():
        pytest.skip(reason)
    python = robot_ros2.python()
    environment = {
        **os.environ,
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_DOMAIN_ID": own_domain(),
        "ROS_LOG_DIR": str(tmp_path / "log"),
        "ROSLENS_COUNTERS": str(tmp_path / "counters"),
        "ROSLENS_ROS2_PYTHON": python,
    }
    with running(str(ROSLENS), "run", "--", python, "-c", TALKER2, environment=environment):
        found = watch_twice("ros2", environment, tmp_path)
    judged(found, set())


def answered(port, seconds=30.0):
    end = time.monotonic() + seconds
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), 1.0).close()
            return
        except OSError:
            assert time.monotonic() < end
            time.sleep(0.05)
