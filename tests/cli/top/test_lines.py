import pytest

from roslens.cli.top.lines import Look, alert_lines, detail_lines, head, lines, visible
from roslens.cli.top.past import Past
from roslens.dashboard.live.detail import Detail, Judgement, Value
from roslens.dashboard.live.snapshot import Alert, Picture, Row, Snapshot
from roslens.report.writing.terminal import Terminal

WIDE, ASCII = Terminal(80, color=True, unicode=True), Terminal(80, color=False, unicode=False)
ROWS = (
    Row("h", "host:rover", "rover", "host", 0, "ok", below="1 absent below"),
    Row("n", "node:/lidar", "/lidar", "node", 1, "unjudged"),
    Row("t", "topic:/scan", "/scan", "topic", 2, "absent", values={"rate": 0.0}, shown={"rate": "0 Hz"}),
    Row("p", "node:/planner", "/planner", "node", 1, "ok"),
)
FOLLOWS = Alert("b", "topic:/cmd_vel", "/cmd_vel", "topic", "absent", "error", "is silent", 2.0, "12:00:02")
ALERT = Alert("a", "topic:/scan", "/scan", "topic", "absent", "error", "is silent", 1.0, "12:00:01", follows=(FOLLOWS,))
SNAPSHOT = Snapshot(
    2, 5.0, "12:00:05", "rover", True, "absent", {"ok": 2, "absent": 1}, "2 % of a core", (("rate", "Rate"),), ROWS,
    (ALERT,), Picture(), (), (), 1,
)  # fmt: skip


def names(look):
    return [row.name for row, _ in visible(SNAPSHOT, look)]


def test_closed_rows_hide_their_parts_and_a_filter_shows_what_is_above():
    assert names(Look()) == ["rover", "/lidar", "/scan", "/planner"]
    assert names(Look(closed=frozenset({"n"}))) == ["rover", "/lidar", "/planner"]
    assert names(Look(filter="scan")) == ["rover", "/lidar", "/scan"]
    assert names(Look(filter="scan", closed=frozenset({"h"}))) == ["rover", "/lidar", "/scan"]
    assert names(Look(worse=True)) == ["rover", "/lidar", "/scan"]
    assert names(Look(filter="nothing")) == []


@pytest.mark.parametrize(("terminal", "sign"), [(WIDE, "✖ absent"), (ASCII, "x absent")])
def test_a_row_has_its_own_state_and_what_is_below_in_words(terminal, sign):
    found = lines(SNAPSHOT, Look(), Past(), (("rate", "Rate"),), terminal=terminal)
    assert found[2].cells[:3] == (sign, "      /scan", "0 Hz")
    assert "rover  (1 absent below)" in found[0].cells[1]
    assert found[1].cells[0].endswith("not judged")


def test_alerts_are_told_by_first_cause():
    texts = [text for _, text, _ in alert_lines([ALERT], WIDE)]
    assert texts[0] == "✖ absent  12:00:01  /scan: is silent"
    assert texts[1] == "  ↳ ✖ absent  12:00:02  /cmd_vel: is silent"


def test_the_first_line_says_when_what_is_shown_is_not_current():
    assert head(SNAPSHOT, "robot:8080", "") == ("rover  12:00:05  2 ok, 1 absent, 1 not judged  costs 2 % of a core")
    assert "NOT CURRENT: does not answer" in head(SNAPSHOT, "robot:8080", "does not answer")
    assert head(None, "robot:8080", "") == "robot:8080  waiting for the first look"


def test_a_detail_tells_each_constraint_and_each_signal_with_its_past():
    past = Past()
    past.take(SNAPSHOT)
    judged = Judgement(
        "rover.scan", "Rate", "0 Hz", "25..35 Hz", "absent", "error", "12:00:01", text="Look at the cable",
        where="rover.yaml:9",
    )  # fmt: skip
    found = Detail(
        "topic:/scan", "/scan", "topic", "12:00:05", "from the recording", (judged,),
        (Value("rate", "Rate", "0 Hz", "Messages a second."),),
    )  # fmt: skip
    text = detail_lines(found, past, WIDE)
    assert text[0] == "topic /scan"
    assert "✖ absent: Rate 0 Hz, expected 25..35 Hz, since 12:00:01" in text
    assert "    rover.yaml:9" in text
    assert text[-1].startswith("Rate")
    assert text[-1].endswith("▄")


def test_what_comes_from_outside_reaches_no_terminal_as_a_command():
    hostile = Row("x", "node:x", "/a\x1b[31m\u202eb", "node", 0, "ok")
    snapshot = Snapshot(2, 1.0, "", "", True, "ok", {}, "", (), (hostile,), (), Picture(), (), ())
    [one] = lines(snapshot, Look(), Past(), (), terminal=WIDE)
    assert "\x1b" not in one.cells[1]
    assert "\u202e" not in one.cells[1]
