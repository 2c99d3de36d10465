"""What is left of a table after the mending."""

import msgspec

from graph_findings.again import left_of
from graph_findings.first_findings import read_shown, section
from graph_findings.judgements import Judgement, Sample


def test_what_is_gone_or_a_note_by_now_is_not_left():
    rows = [
        Judgement("a/b", "cpp.a", "warning", "a.cpp", line, "file:a.cpp", "m", verdict, "w")
        for line, verdict in ((1, True), (2, True), (3, False), (4, False), (5, None))
    ]
    sample = Sample(False, 1, 5, "warning", {"a/b": "c"}, {}, {"cpp.a": 5}, {}, rows)
    found = [msgspec.to_builtins(one) for one in rows[:4]]
    found[1]["severity"] = "note"
    assert left_of(sample, {"a/b": [found[0], found[1], found[2]]}) == (2, 2, 1, 1)


def test_the_page_says_how_many_of_the_first_findings_are_worth_acting_on():
    shown = read_shown()
    assert all(0 < len(one.findings) <= 10 for one in shown.values())
    text = "\n".join(section(shown))
    for name, one in shown.items():
        assert f"### {name}: {sum(each.worth for each in one.findings)} of {len(one.findings)} worth" in text
