"""Samples are drawn as said, and the tables of the project are judged in full."""

import msgspec
import pytest
import yaml

from graph_findings.judgements import Judgement, Sample, drawn, read, samples, taken_over, write
from graph_findings.page import GOAL, PAGE, page, shares

FOUND = {
    "a/b": [
        {"rule": rule, "severity": "warning", "path": "x.py", "line": line, "entity": f"node:/{line}", "message": "m"}
        for rule in ("graph.remap", "graph.type")
        for line in range(30)
    ]
}


def sample(*findings, **more):
    usual = {
        "developed_on": True, "seed": 1, "per_rule": 20, "severity": "warning", "repositories": {"a/b": "c1"},
        "not_read": {}, "population": {"graph.remap": 30}, "notes": {"graph.queue": 2}, "findings": list(findings),
    }  # fmt: skip
    return Sample(**{**usual, **more})


def row(line, verdict=None, why=""):
    return Judgement("a/b", "graph.remap", "warning", "x.py", line, f"node:/{line}", "m", verdict, why)


def test_a_sample_is_that_of_its_seed():
    first = drawn(FOUND, 7, 5)
    assert first == drawn({"a/b": list(reversed(FOUND["a/b"]))}, 7, 5)
    assert first != drawn(FOUND, 8, 5)
    assert [one.rule for one in first] == ["graph.remap"] * 5 + ["graph.type"] * 5
    assert len(drawn(FOUND, 7, 50)) == 60


def test_a_repository_with_many_findings_of_a_rule_does_not_decide_alone():
    found = {**FOUND, "c/d": FOUND["a/b"][:2], "e/f": FOUND["a/b"][:7]}
    chosen = [one for one in drawn(found, 7, 6, 3) if one.rule == "graph.remap"]
    assert len(chosen) == 6
    assert max([one.repository for one in chosen].count(name) for name in found) <= 3
    assert len(drawn(found, 7, 50, 3)) == 3 + 2 + 3 + 3
    assert drawn(found, 7, 6, 3) == drawn({name: found[name][::-1] for name in reversed(found)}, 7, 6, 3)


def test_the_sample_of_one_rule_does_not_depend_on_the_others():
    less = {"a/b": [one for one in FOUND["a/b"] if one["rule"] == "graph.type"]}
    assert drawn(less, 7, 5) == drawn(FOUND, 7, 5)[5:]


def test_verdicts_are_taken_over_of_the_same_place_and_commit():
    judged = [sample(row(3, True, "yes"), row(4))]
    assert taken_over([row(3), row(4)], {"a/b": "c1"}, judged) == [row(3, True, "yes"), row(4)]
    assert taken_over([row(3)], {"a/b": "c2"}, judged) == [row(3)]


def test_what_is_written_is_read(tmp_path):
    write(sample(row(3, False, "no: ä")), tmp_path / "s.yaml")
    assert read(tmp_path / "s.yaml") == sample(row(3, False, "no: ä"))
    (tmp_path / "t.yaml").write_text(yaml.safe_dump({"seed": 1}))
    with pytest.raises(msgspec.ValidationError):
        read(tmp_path / "t.yaml")


def test_a_page_counts_what_is_true():
    text = page({"held_out": sample(row(3, True, "yes"), row(4, False, "no"), row(5), developed_on=False)})
    assert "| `graph.remap` | 30 | 2 | 1 | 50 % (few) | 0 |" in text
    assert "1 repositories; no rule was tuned to them." in text
    assert "- `graph.remap`, a/b, `x.py:4`: no" in text
    assert "Notes only: `graph.queue` (2)." in text
    assert "`graph.qos`" in text.partition("of which no warning or error was found here: ")[2].partition(".\n")[0]


def test_the_page_is_that_of_the_tables():
    assert PAGE.read_text("utf-8") == page(samples())


@pytest.mark.parametrize(("name", "one"), samples().items())
def test_each_finding_of_the_tables_is_judged_with_a_reason(name, one):
    assert [row for row in one.findings if row.verdict is None or not row.why.strip()] == []
    assert {row.repository for row in one.findings} <= one.repositories.keys() - one.not_read.keys()


@pytest.mark.parametrize(("name", "one"), [pair for pair in samples().items() if pair[1].developed_on])
def test_where_rules_were_developed_each_that_is_on_is_true_as_often_as_it_must_be(name, one):
    assert {rule: share for rule, share in shares(one).items() if share[0] < GOAL * share[1]} == {}
