import io
import os

import pytest

from roslens.cli.react.ask_terminal import AskTerminal
from roslens.model.acting.reaction import ActionCall, Because, Decision
from roslens.model.entity import EntityId, EntityKind


def decision(number):
    call = ActionCall("restart", EntityId(EntityKind.NODE, "/driver"), {"grace": 1.0})
    because = (Because("topic:/scan", "topic /scan is low", "low", 1.0),)
    return Decision(f"r/{number}.0", "r", "topic:/scan", 0, call, 100.0, because, text="it is slow")


@pytest.fixture
def terminal():
    read, write = os.pipe()
    with os.fdopen(read) as stdin:
        found = AskTerminal(stdin, io.StringIO())
        found.type = lambda text: os.write(write, text.encode())
        yield found
    os.close(write)


def said(terminal):
    return terminal._out.getvalue()


def test_a_question_says_what_and_why_and_is_answered(terminal):
    terminal.ask(decision(1), 160.0)
    assert "[1] restart node:/driver (grace: 1 s) (it is slow), because topic /scan is low? y or n within 60 s" in said(
        terminal
    )
    assert terminal.answers() == []
    terminal.type("y\n")
    ((id_, allowed, who),) = terminal.answers()
    assert (id_, allowed, "in the terminal" in who) == ("r/1.0", True, True)
    terminal.type("y\n")
    assert terminal.answers() == [], "it was answered"


def test_of_several_questions_the_number_says_which(terminal):
    for number in (1, 2):
        terminal.ask(decision(number), 160.0)
    terminal.type("y\n")
    assert terminal.answers() == []
    assert "which one? asked is 1, 2" in said(terminal).lower()
    terminal.type("no 2\nYES 1\n")
    assert [(id_, allowed) for id_, allowed, _ in terminal.answers()] == [("r/2.0", False), ("r/1.0", True)]


def test_what_is_no_answer_is_none_and_a_line_may_come_in_pieces(terminal):
    terminal.ask(decision(1), 160.0)
    terminal.type("maybe\ny 7\ny 1 2\n\ny")
    assert terminal.answers() == []
    assert said(terminal).count("is not an answer") == 3
    terminal.type(" 1\n")
    assert len(terminal.answers()) == 1


def test_a_question_that_is_withdrawn_cannot_be_answered(terminal):
    terminal.ask(decision(1), 160.0)
    terminal.withdraw("r/1.0")
    terminal.type("y 1\n")
    assert terminal.answers() == []
