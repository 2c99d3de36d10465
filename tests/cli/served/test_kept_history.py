"""`roslens serve --history`: what a watch kept is a page, and what is no history is said."""

from __future__ import annotations

import json
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.cli.main import main
from roslens.cli.served.kept_history import history_beside
from roslens.live.past.keeper import Keeper
from roslens.model.errors import StoreError, UsageError
from roslens.store.live.history import History


@pytest.fixture
def kept(tmp_path: Path) -> Path:
    path = tmp_path / "robot.sqlite"
    robot = ScriptedRobot()
    with History.open(path) as history:
        keeper = Keeper(robot.session, history)
        robot.keeper = keeper
        robot.run(5)
        robot.rates["/scan"] = 4
        robot.run(5)
    return path


def test_the_end_is_shown_and_every_moment_before(kept: Path) -> None:
    with history_beside(kept) as page:
        found = json.loads(page.newest())
        assert not found["live"]
        assert [one["entity"] for one in found["alerts"]] == ["topic:/scan"]
        assert json.loads(page.detail("topic:/scan"))["judgements"][0]["state"] == "low"
        assert page.past is not None
        before = json.loads(page.past.snapshot(found["time"] - 5))
        assert before["alerts"] == []
        assert "/lidar" in page.graph().decode()


def test_it_may_be_looked_at_while_it_is_written(kept: Path) -> None:
    with History.open(kept), history_beside(kept) as page:
        assert json.loads(page.newest())["rows"]


def test_a_locked_one_can_be_read(kept: Path) -> None:
    """Who writes holds the lock of writing alone: readers see what was there before."""
    writer = sqlite3.connect(kept, isolation_level=None)
    writer.execute("BEGIN IMMEDIATE")
    with history_beside(kept) as page:
        assert json.loads(page.newest())["rows"]
    writer.close()


def test_one_that_is_not_there_is_said(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="there is no such file"), history_beside(tmp_path / "none.sqlite"):
        pass
    assert not (tmp_path / "none.sqlite").exists()


def test_something_else_is_said(tmp_path: Path) -> None:
    path = tmp_path / "notes.sqlite"
    path.write_text("no database " * 100)
    with pytest.raises(StoreError, match="expected a file that `roslens watch"), history_beside(path):
        pass


def test_one_of_a_newer_roslens_is_said(kept: Path) -> None:
    with closing(sqlite3.connect(kept)) as connection, connection:
        connection.execute("PRAGMA user_version = 999")
    reported = r"written by a newer roslens \(schema 999\).*Upgrade roslens"
    with pytest.raises(StoreError, match=reported), history_beside(kept):
        pass


def test_an_empty_one_is_said(tmp_path: Path) -> None:
    path = tmp_path / "robot.sqlite"
    with History.open(path):
        pass
    with pytest.raises(UsageError, match="nothing is kept in"), history_beside(path):
        pass


def test_one_thing_is_shown_at_a_time(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["serve", str(tmp_path), "--live", "--history", "a.sqlite"]) == 2
    assert "--live with --history; expected one of them" in capsys.readouterr().err
