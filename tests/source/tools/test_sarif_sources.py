"""SARIF as part of a check: files that are imported, and commands that run once they are trusted."""

import json
import stat
import sys
from pathlib import Path

import pytest

from roslens.children.sandbox import LANDLOCK, NONE, sandbox_kind
from roslens.cli.main import main
from roslens.source.tools.running import run_tool
from roslens.source.tools.running.run_tool import ToolRunner

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.org">A</maintainer><license>MIT</license></package>
"""


def sarif(uri="arm/a.cpp", line=1):
    place = {"artifactLocation": {"uri": uri}, "region": {"startLine": line}}
    result = {"ruleId": "r1", "level": "warning", "message": {"text": "m"}}
    result["locations"] = [{"physicalLocation": place}]
    run = {"tool": {"driver": {"name": "mine", "version": "3"}}, "results": [result]}
    return json.dumps({"version": "2.1.0", "runs": [run]})


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "user"))
    package = tmp_path / "ws" / "arm"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    (package / "a.cpp").write_text("int one() { return 1; }\n")
    return tmp_path / "ws"


@pytest.fixture
def check(workspace, capfd):
    def run(*arguments):
        capfd.readouterr()
        code = main(["check", str(workspace), "--jobs", "1", "--format", "json", *arguments])
        out, _ = capfd.readouterr()
        return code, json.loads(out)

    return run


@pytest.fixture
def started(monkeypatch):
    """Words of the programs that are started."""
    calls = []
    run = ToolRunner.run

    def counted(self, words, **more):
        calls.append(list(words))
        return run(self, words, **more)

    monkeypatch.setattr(ToolRunner, "run", counted)
    return calls


def found(report):
    return [(one["path"], one["line"], one["rule"]) for one in report["findings"] if one["tool"] == "mine"]


def said(report):
    return [failure["what"] for failure in report["failures"]]


HERE = [("arm/a.cpp", 1, "mine.r1")]


def test_a_file_is_imported(check, workspace, tmp_path):
    file = tmp_path / "r.sarif"
    file.write_text(sarif())
    code, report = check("--import", str(file))
    assert (code, found(report), said(report)) == (0, HERE, [])
    assert report["run"]["tools"]["mine"] == "3"
    assert {rule["id"] for rule in report["rules"]} >= {"mine.r1"}
    file.write_text(sarif(line=0))
    assert found(check("--import", str(file))[1]) == [("arm/a.cpp", 0, "mine.r1")]
    assert found(check()[1]) == []


def test_files_that_cannot_be_imported_are_failures(check, tmp_path):
    bad, outside = tmp_path / "bad.sarif", tmp_path / "outside.sarif"
    bad.write_text("{")
    outside.write_text(sarif("../../etc/passwd"))
    good, gone = tmp_path / "good.sarif", tmp_path / "gone.sarif"
    good.write_text(sarif())
    code, report = check(*[word for file in (bad, outside, good, gone) for word in ("--import", str(file))])
    assert code == 3
    assert found(report) == HERE
    reported = "\n".join(said(report))
    assert f"'{bad}' was not imported: no SARIF" in reported
    assert f"'{gone}' was not imported: No such file" in reported
    assert "outside.sarif: 1 results that point outside of the workspace were left out" in reported


def test_a_file_that_is_too_large_is_not_read(check, tmp_path, monkeypatch):
    monkeypatch.setattr("roslens.source.tools.sarif.sarif_sources.MOST_BYTES", 10)
    file = tmp_path / "r.sarif"
    file.write_text(sarif())
    code, report = check("--import", str(file))
    assert code == 3
    assert "was not imported: a file of" in said(report)[0]


def test_a_file_that_nobody_looks_at_is_told(check, tmp_path):
    file = tmp_path / "r.sarif"
    file.write_text(sarif("arm/gone.cpp"))
    code, report = check("--import", str(file))
    assert code == 3
    assert said(report) == ["1 results of mine are in files that roslens does not check"]


def command(workspace: Path, body: str, words: str = '["./lint.sh"]'):
    script = workspace / "lint.sh"
    script.write_text(f"#!/bin/sh\n{body}\n")
    script.chmod(script.stat().st_mode | stat.S_IXUSR)
    (workspace / "roslens.toml").write_text(f"[tools.mine]\ncommand = {words}\n")


def test_a_command_runs_once_it_is_trusted_and_then_not_again(check, workspace, started):
    command(workspace, f"cat <<'X'\n{sarif()}\nX\nexit 1")
    code, report = check()
    assert (code, found(report), started) == (3, [], [])
    assert "it is not trusted" in said(report)[0]
    code, report = check("--trust")
    assert (code, found(report), len(started)) == (0, HERE, 1)
    (workspace / "roslens.toml").write_text((workspace / "roslens.toml").read_text() + "# the same\n")
    assert main(["trust", str(workspace)]) == 0
    assert found(check()[1]) == HERE
    assert len(started) == 1
    (workspace / "arm" / "a.cpp").write_text("int two() { return 2; }\n")
    assert found(check()[1]) == HERE
    assert len(started) == 2
    (workspace / "lint.sh").write_text("#!/bin/sh\necho changed\n")
    assert "it is not trusted" in said(check()[1])[0]
    assert len(started) == 2


@pytest.mark.parametrize(
    ("body", "what"),
    [
        ("kill -SEGV $$", "mine was ended by SIGSEGV: it printed nothing"),
        ("echo broken >&2; exit 4", "mine ended with exit code 4: broken"),
        ("echo garbage", "mine wrote no SARIF"),
        ("sleep 30", "mine did not end within 0.5 s"),
    ],
    ids=["crash", "error", "garbage", "hang"],
)
def test_a_command_that_fails_is_told_and_tried_again(check, workspace, started, body, what):
    command(workspace, body)
    with (workspace / "roslens.toml").open("a") as config:
        config.write("[tools]\ntime_limit_s = 0.5\n")
    for times in (1, 2):
        code, report = check("--trust")
        assert code == 3
        assert said(report)[0].startswith(what)
        assert len(started) == times


def test_a_command_may_write_a_file(check, workspace):
    command(workspace, f"echo noise; cat > \"$1\" <<'X'\n{sarif()}\nX", '["./lint.sh", "{output}"]')
    assert found(check("--trust")[1]) == HERE


def test_a_command_that_is_not_there(check, workspace):
    (workspace / "roslens.toml").write_text('[tools.mine]\ncommand = ["no-such-program"]\n')
    code, report = check("--trust")
    assert code == 3
    assert said(report) == ["mine was not run, because 'no-such-program' is not installed"]


def test_tables_that_are_wrong(workspace, capfd):
    for text, what in (
        ("[tools.mine]\n", "without command"),
        ("[tools.mine]\ncommand = []\n", "tools.mine.command = []"),
        ('[tools.mine]\ncommand = ["a"]\nshell = true\n', "unknown key 'tools.mine.shell'"),
        ('[tools.cpplint]\ncommand = ["a"]\n', "[options.cpplint]"),
        ('[tools."Mine!"]\ncommand = ["a"]\n', "a tool is called 'Mine!'"),
    ):
        (workspace / "roslens.toml").write_text(text)
        assert main(["check", str(workspace)]) == 2
        assert what in capfd.readouterr().err


EMPTY = '{"version": "2.1.0", "runs": []}'


@pytest.mark.skipif(sandbox_kind() != LANDLOCK, reason="this kernel has no Landlock")
@pytest.mark.parametrize(
    ("command", "beside"),
    [
        (["make", "-s", "lint"], "Makefile"),
        (["bash", "lint.sh"], "more.sh"),
        ([sys.executable, "scripts/lint.py"], "scripts"),
    ],
)
def test_a_command_runs_nothing_that_was_not_trusted_with_it(workspace, monkeypatch, command, beside, capfd):
    root = Path(workspace)
    print_it = f"echo '{EMPTY}'"
    (root / "Makefile").write_text(f"lint:\n\t@{print_it}\n")
    (root / "lint.sh").write_text(f". ./more.sh || exit 3\n{print_it}\n")
    (root / "more.sh").write_text("true\n")
    (root / "scripts").mkdir()
    (root / "scripts" / "lint.py").write_text(f"import helper\nprint({EMPTY!r})\n")
    (root / "scripts" / "helper.py").write_text("x = 1\n")

    def failures():
        capfd.readouterr()
        main(["check", str(root), "--jobs", "1", "--format", "json", "--no-store", "--no-cache"])
        return [one["what"] for one in json.loads(capfd.readouterr().out)["failures"]]

    (root / "roslens.toml").write_text(f"[tools.lint]\ncommand = {json.dumps(command)}\n")
    main(["trust", str(root)])
    (found,) = failures()
    assert found.startswith("lint ended with exit code")
    (root / "roslens.toml").write_text(f"[tools.lint]\ncommand = {json.dumps(command)}\nreads = ['{beside}']\n")
    main(["trust", str(root)])
    assert failures() == []
    changed = root / beside if (root / beside).is_file() else root / beside / "helper.py"
    with changed.open("a") as stream:
        stream.write("# changed\n")
    (found,) = failures()
    assert "lint was not run, because it is not trusted" in found


def test_without_landlock_a_command_reads_what_was_not_trusted_with_it(workspace, monkeypatch, capfd):
    """SECURITY says so: there it is only its own words that are trusted."""
    monkeypatch.setattr(run_tool, "sandbox_kind", lambda: NONE)
    root = Path(workspace)
    (root / "lint.sh").write_text(f". ./more.sh || exit 3\necho '{EMPTY}'\n")
    (root / "more.sh").write_text("true\n")
    (root / "roslens.toml").write_text('[tools.lint]\ncommand = ["bash", "lint.sh"]\n')
    main(["trust", str(root)])
    capfd.readouterr()
    main(["check", str(root), "--jobs", "1", "--format", "json", "--no-store", "--no-cache"])
    assert json.loads(capfd.readouterr().out)["failures"] == []
