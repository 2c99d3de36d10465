"""What `roslens watch` writes of a step: causes that change alone, notes, and the exit code."""

from __future__ import annotations

import argparse
import json

import msgspec
import pytest

from roslens.cli.watch.never_judged import JudgedOnce, summary_of
from roslens.cli.watch.watch_output import Teller
from roslens.live.join.note import Note, NoteKind
from roslens.live.join.session import Step
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.graph import Change, Event
from roslens.model.verdict import State, Verdict

MAP = Verdict(EntityId(EntityKind.TOPIC, "/map"), "r.map.rate", "rate", State.LOW, 3.0, 9.0, 0.1, ">= 1 Hz")
EXPLAINED = Verdict(MAP.entity, MAP.expectation, "rate", State.LOW, 3.0, 9.0, 0.1, ">= 1 Hz", cause="node:/slam")
READ = Note(9.0, NoteKind.RELOADED, "read a.yaml again: 2 constraints")
KEPT = Note(9.0, NoteKind.KEPT, "the reference as it was before holds on: a.yaml:3:1: no such key", "a.yaml:3:1")


@pytest.fixture
def tell(capsys):
    """Return what was written to standard output and error for steps, and the exit code."""

    def run(*steps, form="text", verbose=False):
        options = argparse.Namespace(output=None, format=form, verbose=verbose, quiet=False, no_color=True, color=False)
        with Teller(options, lambda seconds: f"{seconds:.0f} s") as teller:
            for step in steps:
                teller.tell(step)
            code = teller.code(frozenset(), nothing_seen=False)
        found = capsys.readouterr()
        return found.out.splitlines(), found.err.splitlines(), code

    return run


def test_a_cause_that_changes_alone_is_a_line(tell):
    out, _, _ = tell(Step(9.0, causes=(EXPLAINED,)), Step(10.0, causes=(MAP,)))
    assert out[0].split("  ", 1)[1].strip() == "topic:/map  rate is still low, now because of node:/slam"
    assert out[1].endswith("rate is still low, now by itself, because of nothing else")


def test_lines_that_no_terminal_shows_are_whole(tell):
    long = msgspec.structs.replace(MAP, text="Look at the cable, then at the plug, then at the power. " * 5 + "Call.")
    out, _, _ = tell(Step(9.0, changes=(long,)))
    assert out[0].endswith("Call.")


def test_a_cause_that_changes_alone_is_a_line_of_json_of_its_own(tell):
    out, _, _ = tell(Step(9.0, causes=(EXPLAINED, MAP)), form="json")
    first, second = map(json.loads, out)
    assert (first["is"], first["entity"], first["state"], first["cause"]) == (
        "cause",
        "topic:/map",
        "low",
        "node:/slam",
    )
    assert second["cause"] == ""


def test_a_reference_that_is_read_again_is_told(tell):
    out, err, code = tell(Step(9.0, notes=(READ,)))
    assert (out, err, code) == ([], ["roslens: read a.yaml again: 2 constraints"], 0)
    out, _, _ = tell(Step(9.0, notes=(READ,)), form="json")
    assert json.loads(out[0]) == {"schema": 1, "is": "note", "time": 9.0, "kind": "reloaded", "text": READ.text}


def test_a_watch_that_ends_with_an_old_reference_is_not_clean(tell):
    assert tell(Step(9.0, notes=(KEPT,)))[1:] == ([f"roslens: {KEPT.text}"], 3)
    assert tell(Step(9.0, notes=(KEPT,)), Step(12.0, notes=(READ,)))[2] == 0


def test_what_other_monitors_report_is_a_line_and_other_events_are_where_more_is_asked_for(tell):
    reported = Event(9.0, Change.CHANGED, "node:/m", "diagnostics: 'motor' is ERROR, was OK: hot")
    appeared = Event(9.0, Change.APPEARED, "parameter:/n/rate", "is 10")
    step = Step(9.0, events=(reported, appeared))
    out, _, code = tell(step)
    assert [line.split(maxsplit=2)[2] for line in out] == ["node:/m  diagnostics: 'motor' is ERROR, was OK: hot"]
    assert code == 0
    out, _, _ = tell(step, verbose=True)
    assert out[1].endswith("parameter:/n/rate  appeared is 10")
    out, _, _ = tell(step, form="json")
    assert [json.loads(line)["entity"] for line in out] == ["node:/m", "parameter:/n/rate"]


@pytest.mark.parametrize(
    ("severity", "judged", "code", "said"),
    [
        (Severity.ERROR, True, 0, ""),
        (Severity.WARNING, False, 0, ""),
        (Severity.ERROR, False, 3, "1 verdict of severity error was never judged, such as topic:/map rate since"),
    ],
)
def test_an_error_that_could_not_have_been_noticed_is_no_pass(capsys, severity, judged, code, said):
    options = argparse.Namespace(output=None, format="text", verbose=False, quiet=False, no_color=True, color=False)
    unknown = msgspec.structs.replace(MAP, state=State.UNKNOWN, severity=severity, evidence="it is not observed")
    ok, other = (
        msgspec.structs.replace(MAP, state=State.OK, expectation=name) for name in (MAP.expectation, "r.other")
    )
    with Teller(options, str) as teller:
        teller.tell(Step(1.0, changes=(other, ok) if judged else (other,)))
        teller.tell_unjudged([unknown, other], 2.0)
        assert teller.code(frozenset(), nothing_seen=False) == code
        assert teller.code(frozenset({"unknown"}), nothing_seen=False) == 1
    assert said in capsys.readouterr().err


def test_what_was_never_judged_is_counted_with_what_to_do():
    ok = [msgspec.structs.replace(MAP, state=State.OK, expectation=f"r.{place}") for place in range(10)]
    never = [msgspec.structs.replace(MAP, state=State.UNKNOWN, expectation=f"r.n{place}") for place in range(12)]
    seen = JudgedOnce()
    seen.add(ok)
    text = summary_of(seen.never([*ok, *never]), 22)
    assert text.startswith("12 of 22 never judged, such as topic:/map rate")
    assert "roslens run" in text
    assert "--tap" in text
    seen.add([msgspec.structs.replace(one, state=State.LOW) for one in never])
    assert summary_of(seen.never([*ok, *never]), 22) == ""


def test_the_lines_of_a_step_are_sorted_by_time(tell):
    late = msgspec.structs.replace(MAP, since=7.0, entity=EntityId(EntityKind.TOPIC, "/late"))
    events = (Event(5.0, Change.VANISHED, "node:/m"), Event(8.0, Change.APPEARED, "node:/m"))
    out, _, _ = tell(Step(9.0, changes=(late, MAP), events=events), verbose=True)
    assert [float(line.split()[0]) for line in out] == [3.0, 5.0, 7.0, 8.0]


def test_a_watch_that_could_judge_nothing_is_not_clean(capsys):
    options = argparse.Namespace(output=None, format="text", verbose=False, quiet=False, no_color=True, color=False)
    unknown = msgspec.structs.replace(MAP, state=State.UNKNOWN, evidence="it is published, but not observed")
    ok = msgspec.structs.replace(MAP, state=State.OK)
    found = []
    for changes in ((unknown,), (ok, unknown)):
        with Teller(options, str) as teller:
            teller.tell(Step(1.0, changes=changes))
            teller.tell_unjudged([unknown, unknown], 2.0)
            found.append(teller.code(frozenset(), nothing_seen=False))
    assert found == [3, 0]
    said = capsys.readouterr().err
    assert "nothing could be judged: every verdict stayed unknown" in said
    assert "topic:/map rate since it is published, but not observed" in said
    assert "--tap" in said
