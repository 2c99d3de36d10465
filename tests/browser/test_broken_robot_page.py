"""A newcomer's walk on the page: each fault of the demo robot is named behind the row, with real nodes."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, expect
from ros2_domain import own_domain

from roslens.live.adapters.child import clean_environment
from testbed import robot_ros2

ROOT = Path(__file__).parents[2]
BROKEN = ROOT / "examples" / "broken"
ROSLENS = [sys.executable, "-m", "roslens.cli.main"]
FAULTS = (
    ("qos", "topic:/scan", "/planner can receive nothing: reliable is requested, best_effort offered"),
    ("name", "topic:/cmd_vel", "/planner, which should make it, publishes /cmd_vle instead"),
    ("domain", "topic:/scan", "/lidar runs apart from what was looked at: ROS_DOMAIN_ID is"),
    ("clock", "topic:/odom", "/odometry waits for simulated time, and nobody publishes /clock"),
)

pytestmark = [pytest.mark.real, pytest.mark.timeout(600)]


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    """Return an environment of ROS 2 for this test alone."""
    if reason := robot_ros2.why_not():
        pytest.skip(reason)
    return clean_environment(os.environ) | {
        "ROS_DOMAIN_ID": own_domain(),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_LOG_DIR": str(tmp_path / "log"),
        "ROSLENS_ROS2_PYTHON": robot_ros2.python(),
    }


@contextmanager
def running(command: list[str], environment: dict[str, str], **more: Any) -> Iterator[subprocess.Popen[str]]:
    process = subprocess.Popen(command, env=environment, text=True, **more)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(30)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait(30)
        if process.stderr:
            process.stderr.close()


def test_each_fault_is_named_behind_the_row_of_what_is_missing(
    browser: Browser, visitor_class: Any, environment: dict[str, str], tmp_path: Path
) -> None:
    workspace = tmp_path / "ws"
    shutil.copytree(BROKEN, workspace, ignore=shutil.ignore_patterns(".roslens"))
    # Findings of the example are no matter of this walk.
    check = [*ROSLENS, "check", str(workspace), "-q", "--fail-on", "never"]
    subprocess.run(check, env=environment, check=True, capture_output=True)
    serve = [*ROSLENS, "serve", str(workspace), "--live", "--ros2", "--port", "0"]
    with running(serve, environment, stderr=subprocess.PIPE) as served:
        assert served.stderr
        url = next(found[1] for line in served.stderr if (found := re.search(r"(http://[^\s?]+/)[? ]", line)))
        visitor = visitor_class(browser, url.rstrip("/"))
        for fault, entity, says in FAULTS:
            robot = [robot_ros2.python(), str(BROKEN / "robot.py"), fault, "--other-domain", own_domain()]
            with running(robot, environment, stdout=subprocess.DEVNULL):
                page = visitor.open(f"/live/?select={entity}")
                answer = page.locator("#detail .why-answer")
                answer.locator("button, .why-cause").first.wait_for()
                if (button := answer.get_by_role("button", name="Why?")).is_visible():
                    button.click()
                # It is asked anew while the nodes start.
                expect(answer.locator(".why-cause")).to_contain_text(says)
                expect(answer.locator(".why-how").first).to_be_visible()
                if folder := os.environ.get("ROSLENS_PICTURES"):
                    page.screenshot(path=f"{folder}/broken-{fault}.png")
        visitor.close()
        assert not visitor.problems
