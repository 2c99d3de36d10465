from collections import Counter

import pytest
from graph_findings import collecting
from graph_findings.judgements import read
from graph_findings.repositories import Repository

from accuracy import held_out_drawing
from accuracy.held_out import OPEN, RIGHT, SETS, WRONG, Calls, Endpoint, held_out, rows_of, write_rows
from accuracy.held_out_drawing import IN_ALL, OF_EACH, calls_of, endpoints_of, findings_of

EVERY = {one.name: one for one in held_out()} if SETS.is_dir() else {}


def answer(count, path="a.cpp"):
    made = [
        {"endpoint": {"role": "publisher", "name": f"/t{line}", "type": "p/T"}, "proof": {"path": path, "line": line}}
        for line in range(1, count + 1)
    ]
    return {"configurations": [{"nodes": [{"name": "/n", "endpoints": made}]}]}


@pytest.mark.parametrize("name", EVERY)
def test_a_set_is_whole_and_judged(name):
    one = EVERY[name]
    assert len(one.calls) >= 30
    commits = {row.repository: row.commit for row in one.calls}
    assert len(commits) == len(one.calls)
    for row in one.calls:
        assert 0 < row.calls <= row.lines or (row.calls == 0 < row.lines)
        assert row.shown + row.named <= row.calls
        assert row.lines_shown + row.lines_named <= row.lines
    assert len(one.endpoints) == IN_ALL
    assert {row.judgement for row in one.endpoints} <= {RIGHT, OPEN, WRONG}
    assert all(row.why for row in one.endpoints if row.judgement == WRONG)
    assert max(Counter(row.repository for row in one.endpoints).values()) <= OF_EACH
    assert {row.repository for row in one.endpoints} <= set(commits)
    assert one.warnings.repositories == commits
    assert {row.severity for row in one.notes} <= {"note"}
    assert {row.severity for row in one.warnings.findings} <= {"warning", "error"}
    assert not one.notes or len(one.notes) + len(one.warnings.findings) <= IN_ALL
    for judged in one.notes:
        assert judged.verdict is not None
        assert judged.why
    assert len(one.notes) <= one.about.notes


def test_no_repository_is_in_two_sets():
    every = Counter(row.repository for one in EVERY.values() for row in one.calls)
    assert [name for name, count in every.items() if count > 1] == []


def test_endpoints_are_drawn_by_their_seed_and_few_of_each_repository():
    answers = {"a/b": answer(50), "c/d": answer(3)}
    chosen, every = endpoints_of(answers, 7)
    assert every == 53
    assert Counter(one.repository for one in chosen) == {"a/b": OF_EACH, "c/d": 3}
    assert endpoints_of(answers, 7) == (chosen, every)
    assert endpoints_of(answers, 8)[0] != chosen
    assert len(endpoints_of(answers, 7, count=5)[0]) == 5


def test_the_same_place_and_name_is_drawn_once_and_what_has_no_place_never():
    twice = answer(2)
    twice["configurations"] *= 2
    twice["configurations"][0]["nodes"][0]["endpoints"][0]["proof"] = {"line": 0}
    assert [one.name for one in endpoints_of({"a/b": twice}, 1)[0]] == ["/t2"]


def test_notes_fill_what_warnings_leave():
    def finding(rule, severity, line):
        return {"rule": rule, "severity": severity, "path": "x", "line": line, "message": "m"}

    found = {
        "a/b": [
            *(finding("graph.remap", "warning", line) for line in range(6)),
            *(finding("graph.queue", "note", line) for line in range(9)),
            *(finding("graph.type", "note", line) for line in range(2)),
        ]
    }
    on, notes = findings_of(found, 11, per_rule=4, count=10)
    assert [one.rule for one in on] == ["graph.remap"] * 4
    assert Counter(one.rule for one in notes) == {"graph.queue": 4, "graph.type": 2}


def test_calls_are_counted_with_and_without_definitions(tmp_path):
    (tmp_path / "a.cpp").write_text("void Node::subscribe(int queue);\nint x;\n\n\n\n\n  node.subscribe(queue);\n")
    assert calls_of(tmp_path, "a/b", "c", {}) == Calls("a/b", "c", 1, 0, 0, 2, 0, 0)


def test_the_tables_of_a_set_are_written_and_not_judged(tmp_path, monkeypatch, capsys):
    clone = tmp_path / "clones" / "owner+talk"
    (clone / ".git").mkdir(parents=True)
    (clone / "a.cpp").write_text("  node.subscribe(queue);\n")
    finding = {"rule": "graph.queue", "severity": "note", "path": "a.cpp", "line": 1, "message": "m"}
    monkeypatch.setattr(held_out_drawing, "repositories", lambda folder: [Repository("owner/talk", clone, "c1")])
    monkeypatch.setattr(held_out_drawing, "asked", lambda root: answer(2))
    monkeypatch.setattr(collecting, "findings_of", lambda one: [finding])
    tables = tmp_path / "tables"
    tables.mkdir()
    assert held_out_drawing.main([str(clone.parent), "x", "--seed", "3"], tmp_path / "sets", tables) == 0
    assert "2 of 2 endpoints, 0 warnings and errors, 1 notes" in capsys.readouterr().err
    assert rows_of(tmp_path / "sets/x/calls.csv", Calls) == (Calls("owner/talk", "c1", 1, 1, 0, 1, 1, 0),)
    assert {row.judgement for row in rows_of(tmp_path / "sets/x/endpoints.csv", Endpoint)} == {""}
    assert [row.verdict for row in read(tmp_path / "sets/x/notes.yaml").findings] == [None]
    assert read(tables / "held_out_x.yaml").repositories == {"owner/talk": "c1"}


def test_rows_are_read_as_they_are_written(tmp_path):
    rows = [Calls("a/b", "c", 3, 2, 1, 4, 3, 1), Calls("a/d", "e", 1, 0, 0, 1, 0, 0)]
    write_rows(tmp_path / "x.csv", rows)
    assert rows_of(tmp_path / "x.csv", Calls) == tuple(rows)
