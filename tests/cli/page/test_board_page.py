"""References held against what is there, and notes on alerts that outlive the watch."""

from __future__ import annotations

import json

import msgspec
import pytest
from dashboard.live.scripted_robot import ScriptedRobot, large_robot

from roslens.cli.page.board_page import MOST_ALERTS, notes_beside
from roslens.cli.page.page_document import bounded
from roslens.cli.page.watch_page import PageSource
from roslens.dashboard.live.snapshot import Alert, Snapshot
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.window.signals import BY_KEY
from roslens.model.errors import StoreError
from roslens.store.handled import Handled, HandledAlerts, How

pytestmark = pytest.mark.timed

EXTRA = """
kind: reference
name: rover
defaults: {grace: 0 s}
constraints:
  - {topic: /scan, rate: 8..12 Hz}
  - {topic: /scan, id: also, rate: ">= 5 Hz"}
  - {topic: /scam, id: typo, latency: "<= 1 s"}
"""


def document(robot):
    return msgspec.json.decode(robot.page.newest(), type=Snapshot)


def broken():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(5)
    return robot


def test_an_acknowledged_alert_stays_and_says_who_looks_after_it():
    robot = broken()
    (alert,) = document(robot).alerts
    assert robot.page.board.handle(alert.key, "acknowledge", 0, "anna") == ""
    robot.run()
    (noted,) = document(robot).alerts
    assert (noted.handled, noted.by, noted.until) == ("acknowledged", "anna", "")
    assert document(robot).wrong == 1
    robot.rates.clear()
    robot.run(10)
    robot.rates["/scan"] = 4
    robot.run(6)
    (again,) = document(robot).alerts
    assert again.handled == "", "it is another alert"


def test_a_muted_alert_is_apart_until_its_end_and_no_less_wrong():
    robot = broken()
    (alert,) = document(robot).alerts
    assert robot.page.board.handle(alert.key, "mute", 10, "anna") == ""
    robot.run()
    found = document(robot)
    assert (found.alerts, found.wrong) == ((), 0)
    assert (found.muted[0].key, found.muted[0].by, found.muted[0].until) == (alert.key, "anna", "12:00:21.0")
    assert found.counts["low"] == 1
    assert next(row for row in found.rows if row.entity == "topic:/scan").state == "low"
    robot.run(10)
    assert [one.key for one in document(robot).alerts] == [alert.key]


def test_what_was_noted_can_be_undone():
    robot = broken()
    (alert,) = document(robot).alerts
    robot.page.board.handle(alert.key, "mute", 100, "anna")
    robot.page.board.handle(alert.key, "undo", 0, "bert")
    robot.run()
    assert document(robot).alerts[0].handled == ""


@pytest.mark.parametrize(
    ("key", "how", "seconds", "words"),
    [
        ("", "undone", 0, "expected acknowledge, mute or undo"),
        ("", "mute", 0, "expected up to 604800 s"),
        ("", "mute", 1e9, "expected up to 604800 s"),
        ("nothing", "acknowledge", 0, "There is no alert 'nothing'"),
    ],
)
def test_what_cannot_be_noted_is_said(key, how, seconds, words):
    robot = broken()
    assert words in robot.page.board.handle(key or document(robot).alerts[0].key, how, seconds, "anna")
    robot.run()
    assert document(robot).alerts[0].handled == ""


def test_notes_outlive_the_watch(tmp_path):
    notes = notes_beside(tmp_path / "live.sqlite", "rover", {})
    notes.put(Handled("a", How.MUTED, "anna", 100.0, 90.0, 200.0, "/scan"))
    notes.put(Handled("b", How.ACKNOWLEDGED, "anna", 100.0, 90.0))
    again = notes_beside(tmp_path / "live.sqlite", "rover", {})
    assert again.of("a", 95.0, 199.0).by == "anna"
    assert again.of("a", 95.0, 201.0) is None
    assert again.of("b", 90.0, 1e9).how is How.ACKNOWLEDGED
    assert again.of("b", 91.0, 101.0) is None
    other = notes_beside(None, "rover", {"XDG_STATE_HOME": str(tmp_path)})
    other.put(Handled("c", How.ACKNOWLEDGED, "bert", 1.0))
    assert (tmp_path / "roslens/alerts").is_dir()


def test_a_file_of_something_else_is_an_error(tmp_path):
    path = tmp_path / "x.json"
    path.write_text("{}")
    with pytest.raises(StoreError, match=r"cannot be read.*Move it away"):
        HandledAlerts(path)


def test_notes_that_cannot_be_kept_do_not_hold(tmp_path):
    (tmp_path / "file").write_text("")
    notes = HandledAlerts(tmp_path / "file" / "x.json")
    with pytest.raises(StoreError, match="cannot be kept"):
        notes.put(Handled("a", How.ACKNOWLEDGED, "anna", 1.0))
    assert notes.of("a", 0.0, 1.0) is None


def test_each_constraint_says_what_it_matches_and_what_matches_nothing_comes_first():
    robot = ScriptedRobot(reference=EXTRA)
    found = robot.page.board.references()
    first, *others = found.constraints
    assert (first.id, first.count) == ("rover.typo.latency", 0)
    assert "'/scan'" in first.advice
    assert all(one.count for one in others)
    by = {one.id: one for one in others}
    rate = by["rover.topic.scan.rate"]
    assert (rate.subject, rate.expected, rate.matches, rate.states) == (
        "topic /scan", "rate 8..12 Hz", ("topic:/scan",), {"ok": 1},
    )  # fmt: skip
    assert rate.where.startswith("rover.yaml:")
    (twice,) = found.twice
    assert (twice.entity, twice.quantity) == ("topic:/scan", "rate")
    assert {text for _, text in twice.constraints} == {"8..12 Hz", ">= 5 Hz"}


def test_a_draft_of_what_nothing_judges_is_a_reference_that_holds():
    robot = ScriptedRobot()
    robot.run(60)
    found = robot.page.board.references()
    (proposal,) = found.proposals
    assert proposal.line == '- {topic: "/planner/status", rate: "1.5..3.6 Hz"}'
    assert "2 Hz" in proposal.evidence
    text = robot.page.board.document((proposal.key, "topic:/gone"))
    (read,) = load_reference([GivenText("accepted.yaml", text.encode())], BY_KEY).expectations
    assert read.selector.name == "/planner/status"
    assert robot.page.board.document(()).endswith("constraints: []\n")


def test_of_very_many_alerts_the_first_are_told_and_all_are_counted():
    alerts = tuple(
        Alert(str(number), f"topic:/t{number}", f"/t{number}", "topic", "low", "error", "rate is low", 1.0, "")
        for number in range(10_000)
    )
    one = msgspec.structs.replace(alerts[0], follows=alerts[1:1000])
    robot = ScriptedRobot()
    found = bounded(msgspec.structs.replace(document(robot), alerts=(one, *alerts[1000:])))
    assert (len(found.alerts), found.wrong, found.follow) == (MOST_ALERTS, 9001, 999)
    assert len(found.alerts[0].follows) == MOST_ALERTS
    assert len(msgspec.json.encode(found)) < 200_000


def test_a_large_system_with_everything_wrong_is_one_page():
    robot = large_robot(300)
    robot.rates = {wire[1]: 1 for wire in robot.wires}
    robot.run(8)
    found = json.loads(robot.page.newest())
    assert found["wrong"] + found["follow"] >= 300
    assert isinstance(robot.page, PageSource)
