"""`roslens serve --live`: the pages of a run, and one of what runs."""

from __future__ import annotations

import argparse
import json
import os
import re
import signal
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest
from ros2_domain import own_domain

from roslens.cli.main import main
from roslens.cli.watch.live_beside import live_beside
from roslens.cli.watch.observers import add_observer_arguments
from roslens.cli.watch.param_reference import reference_argument
from roslens.live.adapters.child import clean_environment
from testbed import robot_ros2

ROOT = Path(__file__).parents[2]
ROSLENS = [sys.executable, "-m", "roslens.cli.main"]
REFERENCE = "kind: reference\nname: r\nconstraints:\n  - {host: '*', memory: '>= 1 B', grace: 0 s}\n"
WAIT_S = 90


def test_what_is_to_be_watched_wants_live(capsys):
    assert main(["serve", "--ros2"]) == 2
    assert "--ros2 without --live; expected both" in capsys.readouterr().err
    assert main(["serve", "--reference", "a.yaml"]) == 2
    assert "--reference without --live" in capsys.readouterr().err


@pytest.mark.timed
def test_a_watch_goes_on_until_it_is_left(tmp_path, monkeypatch):
    """No ROS is here: the host itself is watched all the same, and the reference is read again when it changes."""
    for name in ("ROS_MASTER_URI", "ROS_DISTRO", "ROSLENS_ROS2_PYTHON"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("roslens.cli.watch.watch_live._of_ros", lambda options, publishes: [])
    reference = tmp_path / "r.yaml"
    reference.write_text(REFERENCE)
    parser = argparse.ArgumentParser()
    add_observer_arguments(parser)
    parser.set_defaults(bag=None, reference=[reference_argument(str(reference))])
    options = parser.parse_args([])
    with live_beside(options) as page:
        newest = page.newest
        first = _waited(newest, lambda found: found["counts"].get("ok"))
        assert first["live"]
        reference.write_text(REFERENCE.replace(">=", "<="))
        assert _waited(newest, lambda found: found["counts"].get("high"))["alerts"]
    last = newest()
    assert newest() is last


def _waited(newest, wanted):
    end = time.monotonic() + WAIT_S
    while not wanted(found := json.loads(newest())):
        assert time.monotonic() < end, found
        time.sleep(0.05)
    return found


@pytest.mark.real
@pytest.mark.timeout(240)
def test_a_node_that_runs_is_on_a_page_beside_the_others(tmp_path):
    if reason := robot_ros2.why_not():
        pytest.skip(reason)
    environment = clean_environment(os.environ) | {
        "ROS_DOMAIN_ID": own_domain(),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_LOG_DIR": str(tmp_path / "log"),
        "ROSLENS_ROS2_PYTHON": robot_ros2.python(),
    }
    workspace = tmp_path / "ws" / "a"
    workspace.mkdir(parents=True)
    (workspace / "package.xml").write_text(
        '<package format="3"><name>a</name><version>1.0.0</version><description>d</description>'
        '<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>'
    )
    subprocess.run([*ROSLENS, "check", str(workspace.parent), "-q"], env=environment, check=True, capture_output=True)
    node = subprocess.Popen(
        [*ROSLENS, "run", "--", robot_ros2.python(), str(ROOT / "examples" / "robot" / "ros2_lidar.py")],
        env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    served = subprocess.Popen(
        [*ROSLENS, "serve", str(workspace.parent), "--live", "--ros2", "--port", "0"],
        env=environment, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        assert served.stderr
        url = next(found[1] for line in served.stderr if (found := re.search(r"(http://[^\s?]+/)[? ]", line)))
        with urllib.request.urlopen(url) as page:
            assert 'href="/live/"' in page.read().decode()
        end = time.monotonic() + WAIT_S
        while True:
            with urllib.request.urlopen(url + "live/snapshot.json") as answer:
                rows = json.load(answer)["rows"]
            if any(row["entity"] == "topic:/scan" and row["depth"] == 2 for row in rows):
                break
            assert time.monotonic() < end, rows
            time.sleep(0.2)
    finally:
        for process in (served, node):
            process.send_signal(signal.SIGINT)
        for process in (served, node):
            try:
                process.wait(30)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait(30)
        assert served.stderr
        served.stderr.close()
    assert served.returncode == 0
