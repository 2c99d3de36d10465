from graph_findings.judgements import Judgement, Sample

from accuracy.held_out import About, Calls, Endpoint, HeldOut
from accuracy.held_out_page import section


def judged(severity, verdict, line=1, why="because"):
    return Judgement("a/b", "graph.remap", severity, "x.launch", line, "node:/a", "m", verdict, why)


def held(endpoints=(), on=(), notes=()):
    about = About("First set", "abc1234", 1, 2, 300, 3, 40, "Nobody opened it.")
    sample = Sample(False, 3, 20, "warning", {"a/b": "c" * 40}, {}, {"graph.remap": 5}, {}, list(on))
    return HeldOut("one", about, (Calls("a/b", "c" * 40, 4, 2, 1, 5, 3, 1),), tuple(endpoints), sample, tuple(notes))


def test_without_a_set_there_is_no_section():
    assert section(()) == ""


def test_calls_are_summed_both_ways():
    text = section([held()])
    assert "| a/b | `ccccccc` | 4 | 2 | 1 | 1 |" in text
    assert (
        "Of 4 calls 50.0 % are shown, 75.0 % shown or named. By the cruder count, of 5 lines 60.0 % and 80.0 %." in text
    )
    assert "endpoints 2, findings 3. Nobody opened it." in text


def test_endpoints_are_counted_by_how_sure_they_are_and_what_is_said_of_them_is_there():
    rows = (
        Endpoint("a/b", "x.cpp", 1, "publisher", "/t", "p/T", "certain", "right"),
        Endpoint("a/b", "x.cpp", 2, "publisher", "/u", "p/T", "certain", "wrong", "it is /v"),
        Endpoint("a/b", "x.cpp", 3, "publisher", "/*", "p/T", "possible", "open"),
    )
    text = section([held(rows)])
    assert "3 of 300 endpoints" in text
    assert "| certain | 2 | 1 | 0 | 1 |" in text
    assert "| **all** | 3 | 1 | 1 | 1 |" in text
    assert "- wrong, certain, a/b, `x.cpp:2`, `/u`: it is /v" in text


def test_findings_are_counted_by_rule_and_those_of_one_reason_stand_together():
    on = [judged("warning", False, 4), judged("error", False, 9), judged("warning", True)]
    text = section([held(on=on, notes=[judged("note", True)])])
    assert "| `graph.remap` | 3 | 1 | 1 | 1 |" in text
    assert "3 of 5 warnings and errors" in text
    assert "- **on**, `graph.remap`, a/b, `x.launch:4`, `x.launch:9`: because" in text
