"""`roslens serve --bag`: a recording beside the pages of a run, and what it refuses."""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from roslens.cli.conformance.shown_sides import shown_sides
from roslens.cli.main import main
from roslens.cli.page.row_list import RECORDED
from roslens.cli.page.watch_page import PageSource
from roslens.cli.served.recording import recording_beside
from roslens.cli.watch.param_reference import reference_argument

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "examples/recording"
WAIT_S = 120
OTHERS = {"/joystick", "/rosgraph_monitor", "/sonar_board"}
"""Nodes that the source of the rover does not have."""


def options(bag: Path) -> argparse.Namespace:
    reference = [reference_argument(str(EXAMPLE / "rover.yaml"))]
    return argparse.Namespace(bag=[bag], reference=reference, param=[])


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recording") / "rover_drive"
    subprocess.run([sys.executable, EXAMPLE / "record.py", path], check=True, capture_output=True)
    return path


def read_to_the_end(page: PageSource) -> dict:
    until = time.monotonic() + WAIT_S
    while "to the end" not in (found := json.loads(page.newest()))["cost"]:
        assert time.monotonic() < until, found["cost"]
        time.sleep(0.05)
    return found


def test_the_example_has_one_fault_and_it_is_named(bag: Path) -> None:
    with recording_beside(options(bag)) as page:
        # There is something to show before anything was read.
        assert json.loads(page.newest())["title"] == "rover_drive"
        found = read_to_the_end(page)
    assert [(one["entity"], one["state"], one["severity"]) for one in found["alerts"]] == [
        ("topic:/scan", "low", "error")
    ]
    assert not found["live"]
    nodes = {row["name"] for row in found["rows"] if row["kind"] == "node"}
    assert nodes == {"/range_filter", "/rover_base", "/battery_monitor", "/rover_follower"} | OTHERS


def test_moments_of_the_past_name_what_has_no_host_as_the_end_does(bag: Path) -> None:
    with recording_beside(options(bag)) as page:
        found = read_to_the_end(page)
        assert page.past
        line = page.past.timeline(0.0, 0.0)
        assert line
        moments = [json.loads(page.past.snapshot(at)) for at in (line.first, line.marks[0].time, line.last)]
    for one in (found, *moments):
        assert [row["name"] for row in one["rows"] if row["kind"] == "host"] == [RECORDED]
        assert not one["live"]


def test_a_recording_that_is_shown_and_compared_is_one_side(
    bag: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = tmp_path / bag.name
    shutil.copytree(bag, other)
    monkeypatch.chdir(bag.parent)
    with recording_beside(options(bag)) as page:
        read_to_the_end(page)
        for words in ([], [str(bag)], [bag.name, f"{bag}/", f"./{bag.name}"]):
            sides = shown_sides(words, lambda: page.whole, recorded=[bag])
            assert sides
            assert [side.title for side in sides()] == [bag.name]
        sides = shown_sides([str(other)], lambda: page.whole, recorded=[bag])
        assert sides
        # Both have one file name: a heading says which is which.
        assert [side.title for side in sides()] == [f"{one.parent.name}/{one.name}" for one in (bag, other)]
    alone = shown_sides([str(bag), bag.name], None)
    assert alone
    assert len(alone()) == 1


def test_the_healthy_one_has_none(tmp_path: Path) -> None:
    path = tmp_path / "healthy"
    subprocess.run([sys.executable, EXAMPLE / "record.py", path, "--healthy"], check=True, capture_output=True)
    with recording_beside(options(path)) as page:
        found = read_to_the_end(page)
    assert found["alerts"] == []
    assert found["counts"]["ok"] >= 4


def test_what_runs_and_a_recording_are_not_shown_at_once(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["serve", "--live", "--bag", "a.bag"]) == 2
    assert "--live with --bag; expected one of them" in capsys.readouterr().err
