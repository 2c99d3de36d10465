"""Real nodes: a reference drafted from them holds of them, and a change to it counts while they are watched."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from ros2_domain import own_domain

ROOT = Path(__file__).parents[3]
WHEELS = ROOT / "build" / "ros2" / "bin" / "python"
ROSLENS = [sys.executable, "-m", "roslens.cli.main"]
WRONG = "  - {topic: /scan, id: wrong, period: '>= 1 s', grace: 0 s}\n"

pytestmark = [pytest.mark.real, pytest.mark.slow]


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
            [*ROSLENS, "run", "--", python, str(ROOT / "examples" / "robot" / f"ros2_{name}.py")],
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
    words = ["reference", "draft", "--ros2", "--live", "20 s", "-o", str(draft)]
    done = subprocess.run([*ROSLENS, *words], env=environment, capture_output=True, text=True, check=False, timeout=90)
    assert done.returncode == 0, done.stderr
    text = draft.read_text()
    assert "  - topic: /scan\n    type: sensor_msgs/msg/LaserScan\n    rate: " in text
    assert "  - node: /lidar\n    expected: always  # there at " in text
    graph = tmp_path / "graph.yaml"
    words = [
        "watch",
        "--ros2",
        "--for",
        "16 s",
        "--reference",
        str(draft),
        "--format",
        "json",
        "--graph-out",
        str(graph),
    ]
    with subprocess.Popen([*ROSLENS, *words], env=environment, stdout=subprocess.PIPE, text=True) as watch:
        assert watch.stdout
        lines = []
        for line in watch.stdout:
            lines.append(json.loads(line))
            if lines[-1].get("quantity") == "rate" and lines[-1]["entity"] == "topic:/scan" and WRONG not in text:
                text = text.replace("constraints:\n", f"constraints:\n{WRONG}")
                draft.write_text(text)
    assert watch.returncode == 1
    (note,) = [line for line in lines if line["is"] == "note"]
    assert (note["kind"], "again" in note["text"]) == ("reloaded", True)
    wrong = [
        line["expectation"] for line in lines if line["is"] == "verdict" and line["state"] in ("low", "high", "absent")
    ]
    # On a busy machine a message may be late.
    assert {one for one in wrong if "largest_gap" not in one} == {"draft.wrong.period"}
    assert 'name: "sensor_msgs/msg/LaserScan"' in graph.read_text()
