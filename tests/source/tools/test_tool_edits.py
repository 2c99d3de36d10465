"""Fixes of foreign tools, as they tell them."""

import json
from pathlib import Path
from shutil import which

import pytest

from roslens.model.finding import Finding, Severity
from roslens.model.source import Language, Role, SourceFile
from roslens.source.fix.edited_content import edited
from roslens.source.keys import content_hash
from roslens.source.settings import SourceSettings, ToolSettings
from roslens.source.tools.running.run_tool import Ended, ToolError
from roslens.source.tools.running.tool_edits import with_tool_edits

CPP = b"// gr\xc3\xb6\xc3\x9fe\nint  a;\nint b ;int c ;\n"
PYTHON = b'x = "\xc3\xa9"; y = f"a"\nimport os\n'


class Played:
    """Plays what a program prints, and keeps how it was called."""

    def __init__(self, stdout=b"", code=1, error=None):
        self.stdout, self.code, self.error = stdout, code, error
        self.calls = []

    def run(self, words, **_):
        self.calls.append(words)
        if self.error:
            raise self.error
        return Ended(self.code, self.stdout, b"")


@pytest.fixture
def reported(tmp_path, monkeypatch):
    """Return a function that returns findings with the fixes that a tool tells, and failures."""
    program = type("Program", (), {"path": "/usr/bin/tool"})
    monkeypatch.setattr("roslens.source.tools.running.tool_edits.find_program", lambda *_: program)
    files = {}
    for path, language, content in (("a.cpp", Language.CPP, CPP), ("n.py", Language.PYTHON, PYTHON)):
        (tmp_path / path).write_bytes(content)
        files[path] = SourceFile(path, language, Role.OWN, len(content), content_hash(content))

    def tell(tool, runner, *findings):
        settings = SourceSettings(tools=ToolSettings(use=(tool,)))
        return with_tool_edits(findings, files, str(tmp_path), settings, runner)

    tell.root = tmp_path
    return tell


def ruff(code, row, column, fix, applicability="safe"):
    def place(at):
        return {"row": at[0], "column": at[1]}

    return {
        "filename": "./n.py",
        "message": "m",
        "code": code,
        "location": place((row, column)),
        "end_location": place((row, column + 1)),
        "fix": {
            "applicability": applicability,
            "message": "do it",
            "edits": [
                {"content": text, "location": place(start), "end_location": place(end)} for text, start, end in fix
            ],
        },
    }


def finding(rule, path, line, column=0):
    return Finding(rule, Severity.NOTE, "m", path, line, column)


def test_ruff_counts_letters_and_only_what_is_safe_is_taken(reported):
    output = [
        ruff("F541", 1, 14, [('"a"', (1, 14), (1, 18))]),
        ruff("F401", 2, 8, [("", (2, 1), (3, 1))]),
        ruff("E711", 2, 1, [("x", (1, 1), (1, 2))], "unsafe"),
        {**ruff("E999", 1, 1, []), "fix": None},
    ]
    runner = Played(json.dumps(output).encode())
    found, failures = reported(
        "ruff",
        runner,
        finding("ruff.F541", "n.py", 1, 14),
        finding("ruff.F401", "n.py", 2, 8),
        finding("ruff.E711", "n.py", 2, 1),
        finding("cpp.guard", "a.cpp", 1),
    )
    assert not failures
    assert len(runner.calls) == 1
    assert [bool(one.edits) for one in found] == [True, True, False, False]
    edits = [edit for one in found for edit in one.edits]
    assert {edit.made_for for edit in edits} == {content_hash(PYTHON)}
    assert edited(PYTHON, edits).decode() == 'x = "é"; y = "a"\n'


@pytest.mark.parametrize("content", [b"\xef\xbb\xbfimport os\n", b"import os\r\n", b"x = '\xff'\n"])
def test_where_ruff_counts_otherwise_no_fix_is_taken(reported, content):
    (reported.root / "n.py").write_bytes(content)
    output = json.dumps([ruff("F401", 1, 8, [("", (1, 1), (2, 1))])]).encode()
    found, failures = reported("ruff", Played(output), finding("ruff.F401", "n.py", 1, 8))
    assert not found[0].edits
    assert not failures


def test_clang_format_tells_replacements_in_bytes(reported):
    def replaced(what, text):
        start = CPP.index(what)
        return f"<replacement offset='{start}' length='{len(what)}'>{text}</replacement>"

    output = (
        "<?xml version='1.0'?>\n<replacements xml:space='preserve' incomplete_format='false'>\n"
        + replaced(b"  a", " a")
        + replaced(b" ;int", ";&#10;int")
        + replaced(b" ;\n", ";&#10;")
        + "</replacements>"
    ).encode()
    runner = Played(output, 0)
    found, failures = reported(
        "clang_format", runner, *(finding("clang_format.violation", "a.cpp", line) for line in (2, 3))
    )
    assert not failures
    assert "--output-replacements-xml" in runner.calls[0]
    assert [len(one.edits) for one in found] == [1, 2]
    assert edited(CPP, [edit for one in found for edit in one.edits]).decode() == "// größe\nint a;\nint b;\nint c;\n"
    # What is silenced is not among the findings, and stays.
    found, _ = reported("clang_format", runner, finding("clang_format.violation", "a.cpp", 2))
    assert edited(CPP, found[0].edits).decode() == "// größe\nint a;\nint b ;int c ;\n"


@pytest.mark.parametrize(
    ("tool", "runner", "said"),
    [
        ("ruff", Played(b"panic"), "a JSON array of findings"),
        ("ruff", Played(b"[]", 2), "ended with exit code 2"),
        ("clang_format", Played(b"<x", 0), "XML with the root <replacements>"),
        ("clang_format", Played(error=ToolError("did not end within 600 s")), "did not end within 600 s"),
    ],
)
def test_a_tool_that_fails_is_told_and_the_findings_stand(reported, tool, runner, said):
    given = finding(f"{tool}.x", "n.py" if tool == "ruff" else "a.cpp", 1)
    found, (failure,) = reported(tool, runner, given)
    assert found == (given,)
    assert failure.tool == tool
    assert said in failure.what


def test_a_tool_is_not_asked_about_a_file_that_changed(reported):
    (reported.root / "a.cpp").write_bytes(b"int a;\n")
    runner = Played(b"", 0)
    found, failures = reported("clang_format", runner, finding("clang_format.violation", "a.cpp", 2))
    assert not runner.calls
    assert not failures
    assert not found[0].edits


@pytest.mark.skipif(not which("clang-format"), reason="clang-format is not installed")
def test_real_clang_format_is_understood(tmp_path):
    (tmp_path / ".clang-format").write_text("BasedOnStyle: Google\n")
    (tmp_path / "a.cpp").write_bytes(CPP)
    files = {"a.cpp": SourceFile("a.cpp", Language.CPP, Role.OWN, len(CPP), content_hash(CPP))}
    given = [finding("clang_format.violation", "a.cpp", line) for line in (2, 3)]
    settings = SourceSettings(tools=ToolSettings(use=("clang_format",)))
    found, failures = with_tool_edits(given, files, str(tmp_path), settings)
    assert not failures
    after = edited(CPP, [edit for one in found for edit in one.edits])
    assert after.decode() == "// größe\nint a;\nint b;\nint c;\n"
    assert Path(tmp_path, "a.cpp").read_bytes() == CPP
