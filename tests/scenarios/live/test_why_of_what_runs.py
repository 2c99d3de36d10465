"""``roslens why`` of real nodes of ROS 2: a domain that differs, and a topic that flows."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from ros2_domain import own_domain

ROBOT = Path(__file__).parents[3] / "examples" / "robot"


@pytest.fixture
def robot(python: str, alone: dict[str, str], tmp_path: Path) -> Iterator[dict[str, str]]:
    """Odometry and planner run in one domain, the lidar in another."""
    other = own_domain()
    while other == alone["ROS_DOMAIN_ID"]:
        other = own_domain()
    names = {"odometry": alone, "planner": alone, "lidar": alone | {"ROS_DOMAIN_ID": other}}
    nodes = [
        subprocess.Popen(
            [python, str(ROBOT / f"ros2_{name}.py")], env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        for name, env in names.items()
    ]
    yield alone | {"OTHER": other}
    for one in nodes:
        one.terminate()
    for one in nodes:
        one.wait(20)


def asked(env: dict[str, str], *words: str) -> dict[str, object]:
    done = subprocess.run(
        [sys.executable, "-m", "roslens.cli.main", "why", *words, "--no-source", "--ros2", "--json", "-q"],
        env=env, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    assert done.returncode in (0, 1), done.stderr
    answer: dict[str, object] = json.loads(done.stdout)
    return answer


def test_a_publisher_in_another_domain_is_the_cause_and_what_flows_has_none(robot: dict[str, str]) -> None:
    flows = asked(robot, "/odom", "--tap", "/odom", "--for", "6s")
    assert flows["cause"] is None, flows
    states = {one["asks"]: one["state"] for one in flows["steps"]}  # type: ignore[attr-defined]
    assert states["made by"] == states["sent"] == states["QoS"] == "ok"
    lost = asked(robot, "/scan")
    assert lost["cause"]["asks"] == "made by"  # type: ignore[index]
    lines = "\n".join(lost["cause"]["evidence"])  # type: ignore[index]
    assert "ros2_lidar.py" in lines
    assert f"ROS_DOMAIN_ID is {robot['OTHER']}, looked at is {robot['ROS_DOMAIN_ID']}" in lines
