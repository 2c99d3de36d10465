"""The table on the terminal: what has a row, how it is called, and what its state says."""

import pytest

from roslens.cli.watch_screen import screen
from roslens.live.tree import SystemView
from roslens.model.verdict import State
from roslens.report.terminal import Terminal

BAD = {"low": 1}


def connection(publisher, subscriber, state=State.OK, **given):
    name = f"{publisher} > /scan > {subscriber}"
    return SystemView(f"connection:{name}", name, "connection", state, **given)


def robot(*connections, **given):
    topic = SystemView("topic:/scan", "/scan", "topic", children=connections, **given)
    node = SystemView("node:/lidar", "/lidar", "node", children=(topic,))
    host = SystemView("host:base", "base", "host", children=(node,))
    return SystemView("system", "system", "system", children=(host,))


def rows(view, *, unicode=True, width=100):
    terminal = Terminal(width, False, unicode)
    lines = screen(terminal, view, (), title="t", height=100, clock=str)
    return [line.split() for line in lines[2:]]


def test_a_subscriber_has_a_row_and_what_goes_to_nobody_in_particular_has_none():
    known, nobody = connection("/lidar", "/planner"), connection("/lidar", "?")
    for connections in ((known,), (known, nobody), (nobody, known)):
        assert rows(robot(*connections)) == [["base"], ["/lidar"], ["/scan"], ["→", "/planner"]]
    assert rows(robot(nobody)) == [["base"], ["/lidar"], ["/scan"]]


def test_what_is_judged_has_a_row_whoever_gets_it():
    judged = connection("/lidar", "?", State.LOW, counts=BAD)
    assert rows(robot(judged))[-1] == ["▼", "low", "→", "?"]


def test_a_plain_terminal_has_a_plain_arrow():
    assert rows(robot(connection("/lidar", "/planner")), unicode=False)[-1] == ["->", "/planner"]


@pytest.mark.parametrize(("counts", "said"), [({}, []), ({"ok": 2}, ["✔", "ok"])])
def test_what_no_sentence_is_about_is_not_called_fine(counts, said):
    assert rows(robot(counts=counts))[2] == [*said, "/scan"]


def test_names_stand_under_each_other_whether_judged_or_not():
    lines = screen(Terminal(100, False, True), robot(counts=BAD), (), title="t", height=100, clock=str)
    assert [len(line) - len(line.lstrip()) for line in lines[2:4]] == [12, 14]
    assert lines[4].index("/scan") == 16
