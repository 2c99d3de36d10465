"""*Fix first* begins with what is worked on, in the terminal and on the pages."""

import json
import os
import subprocess

import pytest

from roslens.cli.check.kept_changes import changes_of
from roslens.cli.main import main

SOURCE = "try { f(); } catch (std::exception e) { g(e); }"
MANIFEST = (
    '<package format="3"><name>arm</name><version>1.0.0</version><description>An arm</description>'
    '<maintainer email="a@b.org">A</maintainer><license>BSD-3-Clause</license></package>'
)
PERSON = {f"GIT_{role}_{what}": "a@b.example" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}


@pytest.fixture
def workspace(tmp_path):
    root = tmp_path / "ws"
    root.mkdir()

    def commit():
        for words in (("add", "-A"), ("commit", "-qm", "x")):
            subprocess.run(["git", "-C", str(root), *words], check=True, env={**os.environ, **PERSON})

    subprocess.run(["git", "init", "-q", str(root)], check=True)
    (root / "package.xml").write_text(MANIFEST)
    (root / "a.cpp").write_text(f"void a() {{ {SOURCE} }}\n")
    (root / "b.cpp").write_text("void b() { int * p = new int[9]; delete p; }\n")
    commit()
    for number in range(6):
        (root / "b.cpp").write_text(f"void b() {{ int * p = new int[{number}]; delete p; }}\n")
        commit()
    return root


def first_rules(text):
    lines = text.partition("Fix first")[2].splitlines()
    return [line.strip() for line in lines if line.startswith("       ") and "commit" in line]


def test_the_file_that_changes_most_comes_first_and_says_so(workspace, capsys):
    assert main(["check", str(workspace), "-q", "--jobs", "1"]) == 0
    shown = first_rules(capsys.readouterr().out)
    assert "cpp.delete_form" in shown[0]
    assert shown[0].endswith("7 commits to the file in a year")
    assert "cpp.catch_by_value" in shown[1]
    kept = json.loads((workspace / ".roslens" / "recent_changes.json").read_text())
    assert kept["commits"]["b.cpp"] == 7


def test_git_is_asked_once_for_a_run(workspace, monkeypatch, capsys):
    main(["check", str(workspace), "-q", "--jobs", "1"])
    first = capsys.readouterr().out
    monkeypatch.setattr("roslens.source.history.recent_changes.git_answer", None)
    main(["check", str(workspace), "-q", "--jobs", "1"])
    assert capsys.readouterr().out.partition("Fix first")[2] == first.partition("Fix first")[2]


def test_what_somebody_wrote_into_the_file_is_no_answer(workspace, tmp_path, capsys):
    class View:
        id = 1
        packages = tuple
        workspace = type("W", (), {"findings": ()})

    (tmp_path / "recent_changes.json").write_text("[1")
    assert changes_of(View, tmp_path) == {}
    assert changes_of(View, None) == {}
