"""Findings in an editor's own columns, what they mean, and the comment that silences one."""

import pytest

from roslens.cli.editor.editor_findings import HINT, Span, failure_as_finding, hover_text, ignore_edits, shown, span_of
from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.source import Location

LINES = ["first\n", '    x = "ä😀";  call();\n', "last"]


def at(line=0, column=0, end_line=0, end_column=0, **more):
    return Finding("a.rule", Severity.WARNING, "m", "a.cpp", line, column, end_line, end_column, **more)


@pytest.mark.parametrize(
    ("finding", "span"),
    [
        (at(), Span(0, 0, 5)),
        (at(2), Span(1, 4, 23)),
        # In bytes the call begins at column 20: ä has two, the face four; in UTF-16 they have one and two.
        (at(2, 20, 2, 25), Span(1, 16, 22)),
        (at(2, 5, 9, 1), Span(1, 4, 23)),
        (at(99, 7), Span(2, 4, 4)),
        (at(1, 3, 1, 1), Span(0, 2, 5)),
    ],
)
def test_ranges(finding, span):
    assert span_of(finding, LINES) == span


def test_an_empty_file_has_a_range():
    assert span_of(at(3, 2), []) == Span(0, 0, 0)


def test_what_does_not_count_is_a_hint():
    found = shown([at(1), at(1, gated=False)], LINES)
    assert [one.severity for one in found] == [2, HINT]


def test_hover_says_what_to_write_instead_how_often_the_rule_is_right_and_how_to_silence_it():
    rule = RuleInfo(
        "node.x", "X", "d", languages=("python",), fix="It goes.", precision=0.9, read=20, bad="bad()", good="good()"
    )
    text = hover_text([Finding("node.x", Severity.NOTE, "m")], {"node.x": rule})
    assert "Instead:\n\n```python\ngood()\n```" in text
    assert "Safe fix: It goes." in text
    assert "18 of 20 findings that were read in repositories that it was not written for were true." in text
    assert "To leave it out here: `# roslens: ignore[node.x] reason`" in text


def test_hover_says_what_the_rule_means():
    rule = RuleInfo("a.rule", "A title", "What it finds.", rationale="Why.", url="")
    text = hover_text([at(1), at(1), Finding("b.rule", Severity.NOTE, "n")], {"a.rule": rule})
    said = "- m (may be wrong at run time, likely)\n"
    assert text.startswith(f"**A title** (`a.rule`)\n\n{said}{said}\nWhat it finds.\n\nWhy.\n\n")
    assert text.endswith("**b.rule** (`b.rule`)\n\n- n (hard to maintain, likely)")


@pytest.mark.parametrize(
    ("path", "finding", "text", "line"),
    [
        ("a.cpp", at(2), "  // roslens: ignore[a.rule] ", 1),
        ("a.py", at(2), "  # roslens: ignore[a.rule] ", 1),
        ("CMakeLists.txt", at(1), "  # roslens: ignore[a.rule] ", 0),
        ("a.py", at(), "  # roslens: ignore-file[a.rule] ", 0),
    ],
)
def test_the_comment_that_silences(path, finding, text, line):
    (edit,) = ignore_edits(finding, path, LINES)
    assert (edit.text, edit.line) == (text, line)


def test_no_comment_where_it_would_change_what_is_meant():
    assert ignore_edits(at(1), "a.launch", LINES) == ()
    assert ignore_edits(at(1), "a.cpp", ["#define A \\\n", "  b\n"]) == ()


def test_a_failure_is_shown():
    one = failure_as_finding(Failure("syntax", "'x'", advice="Mend it", location=Location("a.cpp", 3, 2), partial=True))
    assert (one.severity, one.line, one.message) == (Severity.WARNING, 3, "not analysed: 'x'. Mend it")
