"""Tools as part of a run: opt in, once for what is new, and a tool that cannot is said and loses nothing."""

import json
from pathlib import Path

import pytest

from roslens.cli.main import main
from roslens.source.tools.running.programs import Program
from roslens.source.tools.running.run_tool import Ended, ToolError

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.org">A</maintainer><license>MIT</license></package>
"""
OLD = "int old_one() { return 1; }\n"


class Played:
    """A cpplint that says one thing of each file; ``fails`` by the name of the file."""

    calls: list[list[str]]
    links: list[str]
    fails: dict[str, str]
    version = "cpplint 2.0.2"

    def __init__(self, **_):
        self.started = 0

    def run(self, words, *, folder, time_limit_s, safe_path=True, sandbox=None, variables=None):
        if words[1:] == ["--version"]:
            self.calls.append(["--version"])
            return Ended(0, self.version.encode(), b"")
        files = words[words.index("--") + 1 :]
        apart = f"{sandbox.write[0]}/workspace/"
        type(self).words = words
        type(self).links = [file for file in files if file.startswith(apart)]
        self.calls.append([file.replace(apart, "./") for file in files])
        for file in files:
            if file in self.fails:
                raise ToolError(self.fails[file])
        done = "".join(f"Done processing {file}\n" for file in files)
        found = "".join(f"{file}:1:  Use int16_t rather than short  [runtime/int] [4]\n" for file in files)
        return Ended(1, done.encode(), found.encode())

    def end_all(self):
        pass


@pytest.fixture
def played(monkeypatch):
    monkeypatch.setattr(Played, "calls", [], raising=False)
    monkeypatch.setattr(Played, "fails", {}, raising=False)
    monkeypatch.setattr("roslens.source.tools.running.tool_stage.ToolRunner", Played)
    here = {"cpplint": Program("/usr/bin/cpplint", "1")}
    monkeypatch.setattr("roslens.source.tools.running.tool_stage.find_program", lambda name, root: here.get(name))
    return Played


@pytest.fixture
def workspace(tmp_path):
    package = tmp_path / "ws" / "arm"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    for name in ("a", "b", "c"):
        (package / f"{name}.cpp").write_text(OLD)
    return tmp_path / "ws"


@pytest.fixture
def check(workspace, capfd):
    def run(*arguments):
        code = main(["check", str(workspace), "--jobs", "1", "--format", "json", *arguments])
        out, err = capfd.readouterr()
        return code, json.loads(out) if out else None, err

    return run


def found(report):
    return [(one["path"], one["line"], one["rule"]) for one in report["findings"] if one["tool"] == "cpplint"]


ALL = [(f"arm/{name}.cpp", 1, "cpplint.runtime/int") for name in "abc"]


def test_without_the_option_nothing_is_started(check, played):
    _, report, _ = check()
    assert found(report) == []
    assert played.calls == []


def test_findings_have_severity_tags_and_a_rule(check, played):
    code, report, _ = check("--tools", "cpplint")
    assert code == 0
    assert found(report) == ALL
    one = next(one for one in report["findings"] if one["tool"] == "cpplint")
    assert one["severity"] == "note"
    assert {"cpplint", "google", "misra-cpp-2008"} <= set(one["tags"])
    assert one["entity"] == "function:arm/a.cpp#old_one()"
    (rule,) = [rule for rule in report["rules"] if rule["id"] == "cpplint.runtime/int"]
    assert "misra-cpp-2008 3-9-2" in rule["description"]
    assert report["run"]["tools"]["cpplint"] == "2.0.2"
    assert played.calls == [["--version"], ["./arm/a.cpp", "./arm/b.cpp", "./arm/c.cpp"]]


def test_a_second_run_starts_nothing(check, played, workspace):
    check("--tools", "cpplint")
    played.calls.clear()
    assert found(check("--tools", "cpplint")[1]) == ALL
    assert played.calls == []
    (workspace / "arm" / "b.cpp").write_text(OLD + "int two();\n")
    assert found(check("--tools", "cpplint")[1]) == ALL
    assert played.calls == [["./arm/b.cpp"]]


def test_settings_above_a_file_count(check, played, workspace):
    check("--tools", "cpplint", "--trust")
    played.calls.clear()
    (workspace / "CPPLINT.cfg").write_text("set noparent\n")
    check("--tools", "cpplint", "--trust")
    assert len(played.calls) == 1


def test_settings_that_are_not_trusted_do_not_count(check, played, workspace, capfd):
    check("--tools", "cpplint")
    (workspace / "CPPLINT.cfg").write_text("set noparent\n")
    played.calls.clear()
    _, report, reported = check("--tools", "cpplint")
    assert found(report) == ALL
    assert len(played.links) == len(ALL), "no settings are above these"
    assert "tools run without settings files of the workspace until `roslens trust`: CPPLINT.cfg" in reported
    main(["trust", str(workspace)])
    capfd.readouterr()
    _, report, reported = check("--tools", "cpplint")
    assert played.links == []
    assert "roslens trust" not in reported
    (workspace / "CPPLINT.cfg").write_text("set noparent\nfilter=-x\n")
    assert "CPPLINT.cfg" in check("--tools", "cpplint")[2]


def test_a_tool_that_is_not_there(check, played):
    code, report, _ = check("--tools", "cpplint,ruff")
    assert code == 3
    assert found(report) == ALL
    (failure,) = report["failures"]
    assert failure["what"] == "ruff was not run, because it is not installed"
    assert "pip install" in failure["advice"]


def test_all_means_those_that_are_there(check, played):
    code, report, reported = check("--tools", "all")
    assert code == 0
    assert found(report) == ALL
    assert report["failures"] == []
    assert "ruff was not run, because it is not installed" in reported


def test_an_unknown_version(check, played, monkeypatch):
    monkeypatch.setattr(played, "version", "Segmentation fault")
    code, report, _ = check("--tools", "cpplint")
    assert code == 3
    (failure,) = report["failures"]
    assert "it is of an unknown version: `cpplint --version` reports 'Segmentation fault'" in failure["what"]


def test_an_old_version(check, played, monkeypatch):
    monkeypatch.setattr(played, "version", "cpplint 1.0.1")
    (failure,) = check("--tools", "cpplint")[1]["failures"]
    assert "is of version 1.0.1, and versions before 1.5 were not tried" in failure["what"]


def test_what_failed_is_tried_again_and_the_rest_is_known(check, played):
    played.fails["./arm/b.cpp"] = "did not end within 5 s"
    code, report, _ = check("--tools", "cpplint")
    assert code == 3
    assert found(report) == [ALL[0], ALL[2]]
    (failure,) = report["failures"]
    assert failure["what"] == "cpplint did not end within 5 s"
    assert failure["path"] == "arm/b.cpp"
    played.fails.clear()
    played.calls.clear()
    code, report, _ = check("--tools", "cpplint")
    assert code == 0
    assert found(report) == ALL
    assert played.calls == [["./arm/b.cpp"]]


def test_a_name_that_nothing_has(check, played):
    code, _, reported = check("--tools", "cplint")
    assert code == 2
    assert "unknown tool 'cplint'" in reported
    assert "Did you mean 'cpplint'?" in reported


def test_the_configuration_names_tools(check, played, workspace):
    config = workspace / "roslens.toml"
    config.write_text('[tools]\nuse = ["cpplint"]\n\n[options.cpplint]\nline_length = 80\n')
    assert found(check("--trust")[1]) == ALL
    assert found(check("--trust", "--tools", "none")[1]) == []
    config.write_text('disable = ["cpplint"]\n[tools]\nuse = ["cpplint"]\n')
    assert found(check("--trust")[1]) == []
    config.write_text("[tools]\nuses = 3\n")
    code, _, reported = check()
    assert code == 2
    assert f"{config}:2:1" in reported
    assert "unknown key 'tools.uses'" in reported


def test_a_configuration_that_is_not_trusted_starts_no_tool(check, played, workspace, capfd):
    (workspace / "roslens.toml").write_text('[tools]\nuse = ["cpplint"]\n[options.cpplint]\nline_length = 80\n')
    code, report, reported = check()
    assert (code, played.calls) == (3, [])
    (failure,) = report["failures"]
    assert failure["what"] == "cpplint was not run, because roslens.toml, which switches it on, is not trusted"
    assert "[options.cpplint]" in reported
    code, report, _ = check("--tools", "cpplint")
    assert (code, found(report)) == (0, ALL)
    assert "--linelength=100" in played.words, "options of the workspace are not used"
    main(["trust", str(workspace)])
    capfd.readouterr()
    assert check()[0] == 0
    assert "--linelength=80" in played.words


def test_an_option_that_the_tool_does_not_have(check, played, workspace):
    (workspace / "roslens.toml").write_text("[options.cpplint]\nline_lenght = 80\n")
    code, _, reported = check("--trust")
    assert code == 2
    assert "Did you mean 'line_length'?" in reported


def test_a_suppression_in_the_source_holds(check, played, workspace):
    (workspace / "arm" / "a.cpp").write_text("short a; // NOLINT(runtime/int) registers\n")
    assert found(check("--tools", "cpplint")[1]) == ALL[1:]


def test_code_of_others_is_left_out(check, played, workspace: Path):
    (workspace / "roslens.toml").write_text('[workspace]\nvendored = ["b.cpp"]\n')
    assert found(check("--tools", "cpplint")[1]) == [ALL[0], ALL[2]]


def test_the_tools_are_listed(workspace, played, monkeypatch, capsys):
    monkeypatch.setattr("roslens.source.tools.running.programs.find_program", lambda name, root: None)
    assert main(["plugins", str(workspace), "--format", "json"]) == 0
    tools = json.loads(capsys.readouterr().out)["tools"]
    assert {"cpplint", "clang_tidy", "ament_copyright"} <= {tool["name"] for tool in tools}
    assert all(tool["trouble"] == "it is not installed" and tool["get"] for tool in tools)
    main(["doctor", str(workspace)])
    assert "not installed: ament_copyright," in capsys.readouterr().out


def test_a_check_of_a_tool_is_explained(workspace, capsys):
    assert main(["explain", "cpplint.runtime/explicit", str(workspace)]) == 0
    reported = capsys.readouterr().out
    assert "hicpp 12.1.1" in reported
    assert main(["explain", "clang_tidy.bugprone-something-new", str(workspace)]) == 0
    assert "bugprone-something-new" in capsys.readouterr().out
