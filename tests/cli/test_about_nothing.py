"""Constraints about nothing, as they are reported."""

from __future__ import annotations

from roslens.cli.watch.about_nothing import MOST, about_nothing, errors_about_nothing, kinds_of, lines_of
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.join.note import Note, NoteKind
from roslens.live.join.session import Session
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.graph import Graph, Node
from roslens.model.wire import VERSION, Frame

TEXT = b"kind: reference\nname: r\nconstraints:\n  - {node: /b, cpu: <= 5 %}\n  - {host: h, cpu: <= 5 %}\n"


def test_one_several_and_too_many():
    notes = [Note(0.0, NoteKind.UNMATCHED, f"sentence {number}") for number in range(MOST + 5)]
    assert lines_of([]) == []
    assert lines_of(notes[:1]) == ["1 constraint matches nothing that was seen:", "  sentence 0"]
    assert lines_of(notes)[0] == f"{MOST + 5} constraints match nothing that was seen:"
    assert lines_of(notes)[-1] == "  and 5 more"
    assert len(lines_of(notes)) == MOST + 2


def test_without_an_observer_of_ros_only_hosts_are_missed():
    reference = load_reference([GivenText("r.yaml", TEXT)], BY_KEY)
    session = Session(reference, start=0.0)
    session.look(1.0)
    assert kinds_of(session) == (EntityKind.HOST,)
    assert [note.where for note in about_nothing(session, reference, 1.0, kinds_of(session))] == ["r.yaml:5"]
    session.take([Frame(VERSION, "ros2", 0, 1.0, graph=Graph("ros2", (Node("/a"),)))])
    session.look(2.0)
    assert [note.where for note in about_nothing(session, reference, 2.0, kinds_of(session))] == [
        "r.yaml:5",
        "r.yaml:4",
    ]
    session.take([Frame(VERSION, "ros2", 1, 2.0, graph=Graph("ros2", (Node("/b", "h"),), hosts=("h",)))])
    session.look(3.0)
    assert about_nothing(session, reference, 3.0, kinds_of(session)) == []


def test_an_error_about_nothing_was_never_judged():
    text = TEXT.replace(b"{node: /b, cpu: <= 5 %}", b"{node: /b*, cpu: <= 5 %, severity: error}")
    reference = load_reference([GivenText("r.yaml", text)], BY_KEY)
    session = Session(reference, start=0.0)
    session.take([Frame(VERSION, "ros2", 0, 1.0, graph=Graph("ros2", (Node("/a"),)))])
    session.look(2.0)
    assert errors_about_nothing(session, reference, kinds_of(session))
    session.take([Frame(VERSION, "ros2", 1, 2.0, graph=Graph("ros2", (Node("/b1", "h"),)))])
    session.look(3.0)
    assert not errors_about_nothing(session, reference, kinds_of(session)), "the host is a warning"
