"""Two users on one host with real Fast DDS: all is listed, nothing arrives, and ``roslens why`` says so. As root."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

NODE = """
import os, sys
import rclpy
from std_msgs.msg import String
# What a later user may not read is loaded before.
rclpy.init()
before = rclpy.create_node("before")
before.create_publisher(String, "before", 1)
before.destroy_node()
rclpy.shutdown()
if sys.argv[2] != "0":
    os.setgid(int(sys.argv[2]))
    os.setuid(int(sys.argv[2]))
rclpy.init()
if sys.argv[1] == "talker":
    node = rclpy.create_node("talker")
    publisher = node.create_publisher(String, "chatter", 10)
    node.create_timer(0.1, lambda: publisher.publish(String(data="x")))
else:
    node = rclpy.create_node("listener")
    node.create_subscription(String, "chatter", lambda _: print("heard", flush=True), 10)
rclpy.spin(node)
"""
NOBODY = "65534"

pytestmark = pytest.mark.skipif(os.geteuid() != 0, reason="becomes another user, which only root may")


@pytest.fixture
def of_all() -> Iterator[Path]:
    """Return a folder that all users may write; that of a test is of its user alone."""
    with TemporaryDirectory() as folder:
        Path(folder).chmod(0o777)
        yield Path(folder)


def test_a_program_of_another_user_is_told_and_hears_nothing(python: str, alone: dict[str, str], of_all: Path) -> None:
    env = alone | {"HOME": str(of_all), "ROS_LOG_DIR": str(of_all)}
    nodes = [
        subprocess.Popen(
            [python, "-c", NODE, name, user], env=env, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
        for name, user in (("talker", "0"), ("listener", NOBODY))
    ]
    try:
        told = ""
        for _ in range(6):
            told = "\n".join(line for one in asked(alone)["steps"] for line in one.get("evidence", ()))
            if "runs as user 65534" in told:
                break
        assert "it runs as user 65534, looked at was as user 0, and none of its nodes is seen" in told
    finally:
        for one in nodes:
            one.kill()
    heard = [one.communicate(timeout=20)[0].count("heard") for one in nodes]
    assert heard == [0, 0]


def asked(env: dict[str, str]) -> dict[str, Any]:
    done = subprocess.run(
        [sys.executable, "-m", "roslens.cli.main", "why", "/chatter", "--no-source", "--ros2", "--json", "-q"],
        env=env, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    if done.returncode not in (0, 1):
        return {"steps": [], "cause": None}
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer
