"""A newcomer's walk: a demo robot is broken in four ways, and ``roslens why`` names each cause in its first line."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import pytest
from ros2_domain import own_domain

BROKEN = Path(__file__).parents[3] / "examples" / "broken"


@contextmanager
def robot(fault: str, python: str, env: dict[str, str]) -> Iterator[None]:
    """Start the robot with a fault by the command that its page names, and end it."""
    command = [python, str(BROKEN / "robot.py"), fault, "--other-domain", own_domain()]
    process = subprocess.Popen(command, env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        process.terminate()
        process.wait(30)


def why(entity: str, env: dict[str, str], cache: Path, *words: str) -> str:
    """Return what is said of an entity, once the nodes of the robot are there."""
    done = subprocess.run(
        [sys.executable, "-m", "roslens.cli.main", "why", entity, str(BROKEN), "--live", "-q", "--no-cache", *words],
        env=env, cwd=cache, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    assert done.returncode in (0, 1), done.stderr
    return done.stdout


def first_cause(entity: str, env: dict[str, str], cache: Path, said: Sequence[str]) -> str:
    """Return the first cause and what to do about it as one line; asked again while nodes start that it needs."""
    found = ""
    for _ in range(6):
        found = " ".join(why(entity, env, cache).partition("\n\n")[2].partition("\n\n")[0].split())
        if all(words in found for words in said):
            break
    return found


FAULTS = [
    ("qos", "/scan",
     ["First cause: /planner can receive nothing: reliable is requested, best_effort offered.",
      "→ offer more at the publisher, or request less at the subscription"]),
    ("name", "/cmd_vel",
     ["First cause: no node that is seen publishes it: /planner, which should make it, publishes /cmd_vle instead.",
      "→ correct the remapping or the name where /planner is started"]),
    ("domain", "/scan",
     ["First cause: no node that is seen publishes it: /lidar runs apart from what was looked at: ROS_DOMAIN_ID is",
      "→ start both sides with the same value", "→ try: roslens why /scan --live --domain"]),
    ("clock", "/odom",
     ["First cause: /odometry waits for simulated time, and nobody publishes /clock.",
      "→ start what publishes /clock", "→ try: ros2 param set /odometry use_sim_time false"]),
]  # fmt: skip


@pytest.mark.parametrize(("fault", "entity", "said"), FAULTS, ids=[one[0] for one in FAULTS])
def test_each_fault_is_the_first_cause(
    fault: str, entity: str, said: list[str], python: str, alone: dict[str, str], tmp_path: Path
) -> None:
    with robot(fault, python, alone):
        found = first_cause(entity, alone, tmp_path, said)
    for words in said:
        assert words in found


def test_the_whole_robot_has_no_cause(python: str, alone: dict[str, str], tmp_path: Path) -> None:
    with robot("none", python, alone):
        for entity in ("/scan", "/cmd_vel", "/odom", "node:/planner"):
            assert first_cause(entity, alone, tmp_path, ["No cause was found"]).startswith("No cause was found")


def test_every_fault_of_the_robot_is_walked() -> None:
    spec = importlib.util.spec_from_file_location("broken_robot", BROKEN / "robot.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert {"none", *(one[0] for one in FAULTS)} == set(module.FAULTS)
    assert module.environment_of("lidar", "domain", 7)["ROS_DOMAIN_ID"] == "7"
