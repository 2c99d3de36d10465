"""What is drafted of being there."""

from __future__ import annotations

import msgspec
import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.drafting.draft_presence import Attendance, There, there_in, types_in
from roslens.live.drafting.draft_session import DraftSession
from roslens.live.drafting.draft_text import Beside, draft_text
from roslens.live.window.signals import BY_KEY
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.traffic.tally import BY_GID, Moments, Tally
from roslens.model.wire import VERSION, Frame


def graph(*names: str, type_: str = "t/T") -> Graph:
    ends = tuple(Endpoint(name, Role.PUBLISHER, f"{name}/out", type_) for name in names)
    rosout = tuple(Endpoint(name, Role.PUBLISHER, "/rosout", "log/L") for name in names)
    return Graph("ros2", tuple(map(Node, names)), ends + rosout)


def test_a_graph_that_was_written_down():
    assert there_in(graph("/b", "/a", "/_hidden", "/x_12345_987")) == (
        There("node", "/a"),
        There("node", "/b"),
        There("topic", "/a/out", "t/T"),
        There("topic", "/b/out", "t/T"),
    )
    assert types_in(graph("/a"))["/a/out"] == "t/T"


def test_what_comes_and_goes_is_left_out_and_losses_are_counted():
    found = Attendance()
    for look in range(60):
        names = ["/always"] + (["/late"] if look >= 50 else []) + (["/gone"] if look < 40 else [])
        found.look(graph(*names, *(["/flaps"] if look not in (20, 30) else [])))
    drafted = {one.name: one for one in found.drafted(60.0) if one.kind == "node"}
    assert {name: (one.seen, one.looks, one.losses) for name, one in drafted.items()} == {
        "/always": (60, 60, 0),
        "/flaps": (58, 60, 2),
    }
    assert drafted["/always"].alarms_per_hour == pytest.approx(180)
    assert drafted["/flaps"].alarms_per_hour == pytest.approx(120)
    assert found.left_out() == ("/gone", "/late")


def test_a_topic_of_two_types_has_none():
    both = Graph("ros2", (), graph("/a").endpoints + graph("/a", type_="u/U").endpoints)
    assert [one.type for one in there_in(both)] == [""]


def test_what_agents_count_is_drafted_by_name_and_once():
    gid = "010faaaa0700000000000000000012ff"
    session = DraftSession(start=100.0)
    ends = (Endpoint("/a", Role.PUBLISHER, "/scan", gid=gid), Endpoint("/b", Role.SUBSCRIPTION, "/scan"))
    session.take([Frame(VERSION, "ros2", 0, 100.0, graph=Graph("ros2", (Node("/a"), Node("/b")), ends))])
    session.look(100.0)
    for second in range(100, 130):
        period = Moments(10, 1.0, 0.1, 0.1, 0.1)
        sent = Tally("/scan", "/a", "", second, second + 1.0, 10, period=period, host="arm")
        taken = Tally("/scan", BY_GID + gid, "/b", second, second + 1.0, 10, period=period, host="arm")
        frame = Frame(VERSION, "arm/one", 0, second + 1.0, [sent, taken], counted_at="here")
        session.take([frame, msgspec.structs.replace(frame, sender="arm/two")])
        session.look(second + 1.0)
    (scan,) = session.observed.drafted()
    assert {line.quantity: line.typical for line in scan.lines}["rate"] == pytest.approx(10)


def test_a_watch_becomes_a_document():
    session = DraftSession(start=100.0)
    for second in range(100, 160):
        period = Moments(10, 1.0, 0.1, 0.1, 0.1)
        tally = Tally("/a/out", "/a", "", second, second + 1.0, 10, period=period)
        frame = Frame(VERSION, "ros2", 0, second + 1.0, [tally], graph=graph("/a", "/b"))
        session.take([frame])
        session.look(second + 1.0)
    assert session.looked == 59.0
    there, observed = session.attendance.drafted(session.looked), session.observed
    text = draft_text("mine", observed.drafted(), observed.left_out(), "a script", Beside(there), ("/x\n",))
    reference = load_reference([GivenText("draft.yaml", text.encode())], BY_KEY)
    assert {one.quantity for one in reference.expectations} == {"rate", "largest_gap"}
    assert [(one.selector.name, one.selector.type) for one in reference.presences] == [
        ("/a", ""),
        ("/b", ""),
        ("/b/out", "t/T"),
    ]
    assert "expected: always  # there at 60 of 60 looks, lost 0 times: at most 180 alarms an hour" in text
    assert "#   /x?" in text
    assert "Too few" not in text
    assert [state.state.bad for state in session.look(161.0).changes] == []
