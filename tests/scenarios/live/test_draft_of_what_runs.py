"""Real nodes: a reference drafted from them holds of them, and a change to it counts while they are watched."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from ros2_domain import own_domain
from watched_until import watch_until

ROOT = Path(__file__).parents[3]
ROBOT = ROOT / "examples" / "robot"
WHEELS = ROOT / "build" / "ros2" / "bin" / "python"
ROSLENS = [sys.executable, "-m", "roslens.cli.main"]
NODE = """
import runpy, sys, time, types
from rclpy.node import Node

log = open(sys.argv[1], "w", buffering=1)


def create_publisher(self, kind, topic, *words, make=Node.create_publisher, **named):
    made = make(self, kind, topic, *words, **named)
    if topic != "/scan":
        return made

    def publish(message):
        log.write(f"{time.time()}\\n")
        made.publish(message)

    return types.SimpleNamespace(publish=publish)


Node.create_publisher = create_publisher
program = sys.argv.pop(2)
del sys.argv[1]
sys.path.insert(0, program.rpartition("/")[0])
runpy.run_path(program, run_name="__main__")
"""
"""A node of the example that writes down when it publishes scans, to tell a late lidar from a wrong verdict."""
BAD = ("low", "high", "absent")
WRONG = "  - {topic: /scan, id: wrong, period: '>= 1 s', grace: 0 s}\n"

pytestmark = pytest.mark.real


@pytest.fixture
def environment(tmp_path: Path) -> Iterator[dict[str, str]]:
    """Run the lidar and the planner of the example, and return the environment to watch them in."""
    python = os.environ.get("ROSLENS_ROS2_PYTHON") or str(WHEELS)
    if not Path(python).exists():
        pytest.skip("no Python with rclpy: `make parts` makes build/ros2, or name one in $ROSLENS_ROS2_PYTHON")
    found = {
        **os.environ,
        "ROS_DOMAIN_ID": own_domain(),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROSLENS_ROS2_PYTHON": python,
        "ROS_LOG_DIR": str(tmp_path),
    }
    found.pop("ROS_MASTER_URI", None)
    nodes = [
        subprocess.Popen(
            [*ROSLENS, "run", "--", python, "-c", NODE, str(tmp_path / f"{name}.log"), str(ROBOT / f"ros2_{name}.py")],
            env=found,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        for name in ("lidar", "planner")
    ]
    yield found
    for node in nodes:
        node.send_signal(signal.SIGINT)
    for node in nodes:
        try:
            node.wait(10)
        except subprocess.TimeoutExpired:
            node.kill()


def test_a_draft_holds_and_changes_to_it_count(environment: dict[str, str], tmp_path: Path) -> None:
    draft = tmp_path / "draft.yaml"
    words = ["reference", "draft", "--ros2", "--live", "15 s", "-o", str(draft)]
    done = subprocess.run([*ROSLENS, *words], env=environment, capture_output=True, text=True, check=False, timeout=90)
    assert done.returncode == 0, done.stderr
    text = draft.read_text()
    assert "  - topic: /scan\n    type: sensor_msgs/msg/LaserScan\n    rate: " in text
    assert "  - node: /lidar\n    expected: always  # there at " in text
    graph = tmp_path / "graph.yaml"

    def changed(lines: list[dict[str, Any]]) -> bool:
        """Add a constraint once the draft is judged; whether that was judged, too."""
        if any(one.get("quantity") == "rate" and one["entity"] == "topic:/scan" for one in lines):
            again = text.replace("constraints:\n", f"constraints:\n{WRONG}")
            if draft.read_text() != again:
                draft.write_text(again)
        return any(one.get("expectation") == "draft.wrong.period" and one["state"] in BAD for one in lines)

    words = ["--ros2", "--reference", str(draft), "--graph-out", str(graph)]
    lines, errors, code = watch_until(changed, words, environment)
    assert code == 1, errors
    (note,) = [line for line in lines if line["is"] == "note"]
    assert (note["kind"], "again" in note["text"]) == ("reloaded", True)
    wrong = [line for line in lines if line["is"] == "verdict" and line["state"] in BAD]
    assert "draft.wrong.period" in {one["expectation"] for one in wrong}
    published = [float(line) for line in (tmp_path / "lidar.log").read_text().split()]
    assert [one for one in wrong if one["expectation"] != "draft.wrong.period" and not was_so(one, published)] == []
    assert 'name: "sensor_msgs/msg/LaserScan"' in graph.read_text()


def was_so(verdict: dict[str, Any], published: list[float]) -> bool:
    """Whether the lidar itself was outside of what is expected of /scan, in the seconds before a verdict."""
    if verdict["entity"] not in ("topic:/scan", "node:/lidar"):
        return False
    end = verdict["time"] + 0.5
    times = [one for one in published if end - 4 <= one <= end]
    bounds = [float(number) for number in re.findall(r"\d+(?:\.\d+)?", verdict["range"])]
    if verdict["quantity"] == "largest_gap":
        scale = 1e-3 if verdict["range"].endswith(" ms") else 1
        return max(after - before for before, after in pairwise([*times, end])) > bounds[-1] * scale
    assert verdict["quantity"] == "rate", verdict
    rates = [sum(begin < one <= begin + 1 for one in times) for begin in times if begin + 1 <= end]
    return min(rates) - 1 < bounds[0] if verdict["state"] == "low" else max(rates) + 1 > bounds[-1]
