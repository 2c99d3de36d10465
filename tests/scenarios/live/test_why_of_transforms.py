"""``roslens why a->b --live`` of real nodes of ROS 2: a whole tree, a part that is missing, and no listener of tf2."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

BROADCASTER = """
import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.qos import QoSDurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

def said(parent, child):
    one = TransformStamped()
    one.header.stamp = node.get_clock().now().to_msg()
    one.header.frame_id, one.child_frame_id = parent, child
    one.transform.rotation.w = 1.0
    return one

rclpy.init()
node = rclpy.create_node("broadcaster")
static = node.create_publisher(
    TFMessage, "/tf_static", QoSProfile(depth=1, durability=QoSDurabilityPolicy.TRANSIENT_LOCAL)
)
static.publish(TFMessage(transforms=[said("base_link", "laser"), said("dock", "charger")]))
moving = node.create_publisher(TFMessage, "/tf", 10)
node.create_timer(0.02, lambda: moving.publish(TFMessage(transforms=[said("map", "odom"), said("odom", "base_link")])))
rclpy.spin(node)
"""


@pytest.fixture
def robot(python: str, alone: dict[str, str], built: Callable[..., Path]) -> Iterator[dict[str, str]]:
    """Transforms are said at 50 Hz, and some once."""
    held = ("geometry_msgs", "std_msgs", "builtin_interfaces")
    folder = built("tf2_msgs", {"TFMessage": "geometry_msgs/TransformStamped[] transforms\n"}, held=held)
    environment = alone | {"PYTHONPATH": str(folder)}
    node = subprocess.Popen([python, "-c", BROADCASTER], env=environment)
    yield environment
    node.kill()
    node.wait(20)


def asked(word: str, env: dict[str, str]) -> dict[str, Any]:
    done = subprocess.run(
        [sys.executable, "-m", "roslens.cli.main", "why", word, "--ros2", "--json", "-q"],
        env=env, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    assert done.returncode in (0, 1), done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def test_transforms_of_what_runs_are_answered(robot: dict[str, str]) -> None:
    for _ in range(6):
        whole = asked("map->laser", robot)
        if whole["cause"] is None:
            break
    assert whole["cause"] is None, whole
    steps = {one["asks"]: one for one in whole["steps"]}
    assert steps["tree"]["says"] == "the way is laser → base_link → odom → map"
    assert "/broadcaster" in steps["made by"]["says"]
    assert steps["last good"]["state"] == "ok"
    apart = asked("map->charger", robot)
    assert apart["cause"]["says"] == "map and charger are in two trees: nothing says where dock is in that of map"
    assert asked("frame:laser", robot)["cause"] is None
    missing = asked("map->lazer", robot)
    assert missing["cause"]["how"].startswith("nearest names: laser for lazer")


def test_a_python_without_tf2_is_said(robot: dict[str, str], alone: dict[str, str]) -> None:
    found = asked("map->laser", alone)
    assert found["cause"] is None
    assert any("has no tf2_msgs" in line for line in found["steps"][0]["evidence"])
