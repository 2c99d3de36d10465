"""The table on the terminal: what has a row, how it is called, and what its state says."""

import msgspec
import pytest

from roslens.cli.page.watch_screen import screen, value_text
from roslens.live.system.tree import SystemView
from roslens.model.verdict import State
from roslens.report.writing.terminal import Terminal

BAD = {"low": 1}


def connection(publisher, subscriber, state=None, **given):
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


def names(view):
    return [" ".join(line).removeprefix("\N{EN DASH} not judged ") for line in rows(view)]


def test_a_subscriber_has_a_row_and_what_goes_to_nobody_in_particular_has_none():
    known, nobody = connection("/lidar", "/planner"), connection("/lidar", "?")
    for connections in ((known,), (known, nobody), (nobody, known)):
        assert names(robot(*connections)) == ["base", "/lidar", "/scan", "→ /planner"]
    assert names(robot(nobody)) == ["base", "/lidar", "/scan"]


def test_names_are_whole_before_there_is_room_for_more_values():
    name = "/estimator/transition_event_of_the_filter"
    values = dict.fromkeys(("rate", "largest_gap", "latency", "cpu", "memory", "bandwidth"), 1.0)
    host = SystemView("host:base", "base", "host", children=(SystemView(f"node:{name}", name, "node", values=values),))
    view = SystemView("system", "system", "system", children=(host,))
    assert name in rows(view, width=120)[-1]
    assert name not in rows(view, width=60)[-1]


@pytest.mark.parametrize(("received", "shown"), [(10.0, False), (1.0, True)])
def test_what_is_received_stands_beside_what_is_sent_and_keeps_its_place_where_it_is_less(received, shown):
    values = {"rate": 10.0, "rate_received": received, "largest_gap": 0.1, "latency": 0.001}
    view = robot(connection("/lidar", "/planner", values={"rate": received}), values=values)

    def head(width):
        return screen(Terminal(width, False, True), view, (), title="t", height=100, clock=str)[1].split()

    assert head(100) == ["rate", "received", "gap", "latency"]
    assert head(70) == (["rate", "received", "gap"] if shown else ["rate", "gap", "latency"])


def test_what_is_judged_has_a_row_whoever_gets_it():
    judged = connection("/lidar", "?", State.LOW, counts=BAD)
    assert rows(robot(judged))[-1] == ["▼", "low", "→", "?"]


def test_a_plain_terminal_has_a_plain_arrow():
    assert rows(robot(connection("/lidar", "/planner")), unicode=False)[-1][-2:] == ["->", "/planner"]


@pytest.mark.parametrize(
    ("state", "said", "plain"),
    [
        (None, "\N{EN DASH} not judged", "- not judged"),
        (State.OK, "✔ ok", "+ ok"),
        (State.UNKNOWN, "? unknown", "? unknown"),
    ],
)
def test_only_what_a_constraint_judged_is_called_fine(state, said, plain):
    assert rows(robot(state=state))[2] == [*said.split(), "/scan"]
    assert rows(robot(state=state), unicode=False)[2] == [*plain.split(), "/scan"]


def test_what_is_wrong_below_stands_apart_from_the_state_of_a_row():
    view = robot(state=State.OK, below={"absent": 1, "ok": 3, "unknown": 2})
    assert " ".join(rows(view)[2]) == "✔ ok /scan (1 absent, 2 unknown below)"


def test_the_first_line_counts_what_nothing_judges():
    view = msgspec.structs.replace(robot(state=State.OK), counts={"ok": 1})
    line = screen(Terminal(100, False, True), view, (), title="t", height=9, clock=str)[0]
    assert line == "t   1 ok, 2 not judged"


def test_names_stand_under_each_other_whether_judged_or_not():
    lines = screen(Terminal(100, False, True), robot(counts=BAD), (), title="t", height=100, clock=str)
    assert [lines[2].index("base"), lines[3].index("/lidar"), lines[4].index("/scan")] == [13, 15, 17]


def test_a_value_has_three_digits_whatever_letters_its_unit_has():
    assert value_text("temperature", 71.52) == "71.5 degC"
    assert value_text("network_in", 2_041_234.0) == "2.04 MB/s"
    assert value_text("cpu", 99.0) == "99 %"
