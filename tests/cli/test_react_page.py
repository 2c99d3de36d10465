"""Questions asked in several places, and refused answers in the journal."""

from __future__ import annotations

from dashboard.journal.test_journal_pages import decision

from roslens.cli.react.react_page import AskEverywhere, write_refusals
from roslens.dashboard.journal.questions import Questions


def test_the_first_answer_counts_and_the_other_place_asks_no_more():
    one, other = Questions(lambda: 0.0), Questions(lambda: 0.0)
    asker = AskEverywhere([one, other])
    asker.ask(decision(1), 160.0)
    asker.ask(decision(2), 160.0)
    assert one.answer("r.one/1.1", allowed=True, by="Ada")
    assert other.answer("r.one/1.1", allowed=False, by="Bob")
    assert asker.answers() == [("r.one/1.1", True, "Ada")]
    assert [asked.decision for asked in other.open()] == ["r.one/2.1"]
    asker.withdraw("r.one/2.1")
    assert one.open() == other.open() == ()
    assert asker.answers() == []


def test_who_was_refused_is_written_down():
    questions, entries = Questions(lambda: 7.0), []

    class Lines:
        def add(self, what, time, **fields):
            entries.append((what, time, fields))

    questions.refused("127.0.0.1", "no key was given")
    write_refusals(questions, Lines())
    write_refusals(questions, Lines())
    assert entries == [("refused-answer", 7.0, {"text": "no key was given", "address": "127.0.0.1"})]
