"""Real nodes of ROS 2 whose message packages were built from different definitions: the watch says on which topic."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

import pytest
from watched_until import watch_until

pytestmark = pytest.mark.real

OLD = "float64 level\n"
NEW = "float64 level\nstring unit\n"
TALKER = """
import rclpy
from gauge_msgs.msg import Gauge
rclpy.init()
node = rclpy.create_node('gauge')
publishers = [node.create_publisher(Gauge, topic, 10) for topic in ('/level', '/spare')]
node.create_timer(0.1, lambda: [one.publish(Gauge(level=1.0)) for one in publishers])
rclpy.spin(node)
"""
LISTENER = """
import rclpy, sys
from gauge_msgs.msg import Gauge
rclpy.init()
node = rclpy.create_node('display')
def came(message):
    sys.stdout.write(str(message) + '\\n')
    sys.stdout.flush()
node.create_subscription(Gauge, '/level', came, 10)
rclpy.spin(node)
"""


def about(lines: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the failures that are about a definition."""
    return [one for one in lines if one["is"] == "failure" and "definition" in one["what"]]


def hears(log: Path) -> bool:
    """Whether the node that writes this log took a message."""
    return "level=1.0" in log.read_text()


@pytest.mark.timeout(240)
def test_the_topic_whose_definitions_differ_is_told(python, built, alone, tmp_path):
    nodes = []
    try:
        old, new = (built("gauge_msgs", {"Gauge": text}, name) for text, name in ((OLD, "old"), (NEW, "new")))
        same = LISTENER.replace("'display'", "'logger'")
        for folder, code in ((old, TALKER), (new, LISTENER), (old, same)):
            with (tmp_path / str(len(nodes))).open("wb") as said:
                environment = alone | {"PYTHONPATH": str(folder)}
                nodes.append(subprocess.Popen([python, "-c", code], env=environment, stdout=said, stderr=said))
        reported = watch_until(lambda lines: bool(about(lines)) and hears(tmp_path / "2"), ["--ros2"], alone)
    finally:
        for node in nodes:
            node.kill()
            node.wait()
    told = about(reported.lines)
    assert [one["entity"] for one in told] == ["topic:/level"], reported
    assert told[0]["what"].startswith("/display does not understand what /gauge publishes on /level")
    displayed, logged = ((tmp_path / str(at)).read_text() for at in (1, 2))
    assert ("level=1.0" in logged, "level=1.0" in displayed) == (True, False)
