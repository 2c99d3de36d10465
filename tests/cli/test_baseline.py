"""``--baseline``, ``--new-only`` and ``--changed`` of ``roslens check``, on a small repository."""

import json
import os
import re
import subprocess
from pathlib import Path

import pytest

from roslens.cli.main import main

LIMITS_ONLY = '[rules]\ndisable = ["*"]\n'
CALLS = "def {}(step):\n" + "".join(f"    step.move_{number}()\n" for number in range(12)) + "    return step\n\n\n"


def git(folder, *arguments):
    who = {f"GIT_{role}_{what}": "a@b.c" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    environment = {**os.environ, **who, "GIT_CONFIG_GLOBAL": "/dev/null"}
    command = ["git", "-C", str(folder), "-c", "init.defaultBranch=main", *arguments]
    subprocess.run(command, check=True, capture_output=True, env=environment)


@pytest.fixture
def walking(talking):
    (talking / "talk/talk/walking.py").write_text(CALLS.format("walk"))
    (talking / ".gitignore").write_text(".roslens\n")
    (talking / "roslens.toml").write_text(LIMITS_ONLY)
    git(talking, "init", "-q")
    git(talking, "add", ".")
    git(talking, "commit", "-qm", "first")
    return talking


def add_finding(root, name="run"):
    with (root / "talk/talk/walking.py").open("a") as stream:
        stream.write(CALLS.format(name))


def check(root, capsys, *more, code, form="json"):
    assert (
        main(["check", str(root), "--format", form, "--jobs", "1", "-q", "--no-graph", "--fail-on", "note", *more])
        == code
    )
    out = capsys.readouterr().out
    return json.loads(out) if form in {"json", "sarif"} else out


def calls(report):
    return [one["entity"].partition("#")[2] for one in report["findings"] if one["rule"] == "ros.calls.max"]


@pytest.mark.parametrize("name", ["HEAD", "main"])
def test_a_revision(walking, capsys, name):
    assert check(walking, capsys, "--baseline", name, "--new-only", code=0)["findings"] == []
    add_finding(walking)
    report = check(walking, capsys, "--baseline", name, "--new-only", code=1)
    assert calls(report) == ["run(step)"]
    assert len(report["files"]) > 1
    whole = check(walking, capsys, "--baseline", name, code=1)
    assert {
        one["entity"].partition("#")[2]: one["new"] for one in whole["findings"] if one["rule"] == "ros.calls.max"
    } == {
        "walk(step)": False,
        "run(step)": True,
    }


def test_a_rename_is_not_new(walking, capsys):
    git(walking, "mv", "talk/talk/walking.py", "talk/talk/striding.py")
    git(walking, "commit", "-qm", "renamed")
    assert check(walking, capsys, "--baseline", "HEAD~1", "--new-only", code=0)["findings"] == []


def test_what_others_changed_meanwhile_is_not_new(walking, capsys):
    git(walking, "checkout", "-qb", "topic")
    git(walking, "checkout", "-q", "main")
    (walking / "talk/talk/walking.py").write_text("")
    git(walking, "commit", "-qam", "main has mended it")
    git(walking, "checkout", "-q", "topic")
    assert check(walking, capsys, "--baseline", "main", "--new-only", code=0)["findings"] == []


@pytest.mark.parametrize("form", ["json", "sarif"])
def test_a_report(walking, capsys, tmp_path, form):
    kept = tmp_path / f"kept.{form}"
    assert main(["check", str(walking), "-o", str(kept), "--jobs", "1", "-q", "--no-graph"]) == 0
    assert check(walking, capsys, "--baseline", str(kept), "--new-only", code=0)["findings"] == []
    add_finding(walking)
    results = check(walking, capsys, "--baseline", str(kept), code=1, form="sarif")["runs"][0]["results"]
    states = {
        one["locations"][0]["logicalLocations"][0]["fullyQualifiedName"].partition("#")[2]: one["baselineState"]
        for one in results
        if one["ruleId"] == "ros.calls.max"
    }
    assert states == {"walk(step)": "unchanged", "run(step)": "new"}


def test_a_kept_run(walking, capsys):
    check(walking, capsys, code=1)
    add_finding(walking)
    assert calls(check(walking, capsys, "--baseline", "last", "--new-only", code=1)) == ["run(step)"]
    assert calls(check(walking, capsys, "--baseline", "1", "--new-only", code=1)) == ["run(step)"]
    text = check(walking, capsys, "--baseline", "1", code=1, form="text")
    assert "New since run 1: " in text
    assert "gone: 0" in text


def test_the_first_night_has_nothing_to_compare_with_and_the_second_nothing_new(walking, capsys):
    text = check(walking, capsys, "--baseline", "last", code=1, form="text")
    assert "New since nothing, as no earlier run is kept: " in text
    assert calls(check(walking, capsys, "--baseline", "last", "--new-only", code=0)) == []
    add_finding(walking)
    assert calls(check(walking, capsys, "--baseline", "last", "--new-only", code=1)) == ["run(step)"]


def test_what_is_new_is_to_be_mended_first(walking, capsys):
    check(walking, capsys, code=1)
    deep = "".join(f"{'    ' * depth}if step > {depth}:\n" for depth in range(1, 9))
    (walking / "talk/talk/fresh.py").write_text(f"def dig(step):\n{deep}{'    ' * 9}step.move()\n")
    text = check(walking, capsys, "--baseline", "last", code=1, form="text")
    new = text.partition(" new findings\n")[2].partition("\n\n")[0]
    things = re.split(r"(?m)^  \S (?=\S)", new)[1:]
    assert things
    assert all("talk/talk/fresh.py" in one for one in things)
    assert "hard to maintain, heuristic" in new
    assert "Fix first" not in text


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("no-such-branch", 'git knows no revision "no-such-branch"'),
        ("mian", "Did you mean main?"),
        ("77", "no such run is kept"),
        ("gone.json", "no such file"),
        ("auto", "the repository has no remote"),
    ],
)
def test_a_baseline_that_is_not_there_is_refused_before_anything_is_analysed(walking, capsys, name, said):
    assert main(["check", str(walking), "-q", "--baseline", name]) == 2
    assert said in capsys.readouterr().err
    assert not (walking / ".roslens/cache.sqlite").exists()


def test_auto_is_the_target_of_the_pull_request(walking, capsys, monkeypatch):
    git(walking, "branch", "humble")
    add_finding(walking)
    monkeypatch.setenv("GITHUB_BASE_REF", "humble")
    assert calls(check(walking, capsys, "--baseline", "auto", "--new-only", code=1)) == ["run(step)"]


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("{other}", "is of another workspace"),
        ("{garbage}", "cannot be read"),
        ("{none}", "is not a report of roslens"),
        ("{broken}", "is not as it was written"),
    ],
)
def test_a_baseline_that_is_wrong_is_a_failure_and_the_results_stand(walking, capsys, tmp_path, name, said):
    files = {
        "other": {"schema": "roslens-report/1", "files": [{"path": "x/y.py", "content_hash": ""}], "findings": []},
        "none": [],
        "broken": {"schema": "roslens-report/1", "files": 3, "findings": [{}]},
    }
    for key, content in files.items():
        (tmp_path / key).write_text(json.dumps(content))
    (tmp_path / "garbage").write_text('{"')
    given = name.format(**{key: tmp_path / key for key in (*files, "garbage")})
    report = check(walking, capsys, "--baseline", given, "--new-only", "--fail-on", "never", code=3)
    assert calls(report) == ["walk(step)"]
    (failure,) = report["failures"]
    assert failure["tool"] == "baseline"
    assert said in f"{failure['what']}; {failure['expected']}. {failure['advice']}"


def test_only_what_changed(walking, capsys):
    (walking / "other").mkdir()
    (walking / "other/package.xml").write_text((walking / "talk/package.xml").read_text().replace("talk", "other"))
    (walking / "other/pacing.py").write_text(CALLS.format("pace"))
    git(walking, "add", ".")
    git(walking, "commit", "-qm", "second")
    assert check(walking, capsys, "--changed", code=0)["packages"] == []
    (walking / "talk/talk/fresh.py").write_text(CALLS.format("fresh"))
    report = check(walking, capsys, "--changed", code=1)
    assert (calls(report), [one["name"] for one in report["packages"]]) == (["fresh(step)"], ["talk"])
    assert calls(check(walking, capsys, "--changed", "HEAD~1", code=1)) == ["pace(step)", "fresh(step)"]
    # It is no whole run: one is made by the next check, and has everything again.
    assert not (walking / ".roslens/store.sqlite").exists()
    assert len(calls(check(walking, capsys, code=1))) == 3


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--new-only"], "--new-only without --baseline"),
        (["--changed", "HEAD", "--baseline", "HEAD"], "--changed with --baseline"),
        (["--changed", "nowhere"], 'git knows no revision "nowhere"'),
    ],
)
def test_options_that_mean_nothing(walking, capsys, words, said):
    assert main(["check", str(walking), "-q", *words]) == 2
    assert said in capsys.readouterr().err


def test_a_clean_tree_says_that_nothing_differs(walking, capsys):
    text = check(walking, capsys, "--changed", code=0, form="text")
    assert "No file of a package differs from HEAD." in text
    assert "No packages were found" not in text


def test_the_run_of_changed_files_is_shown_again(walking, capsys, tmp_path):
    (walking / "talk/talk/fresh.py").write_text(CALLS.format("fresh"))
    check(walking, capsys, "--changed", code=1)
    words = ["--no-graph", "-q", "--jobs", "1"]
    assert main(["report", str(walking), "--changed", "-o", str(tmp_path / "out"), *words]) == 0
    page = (tmp_path / "out/findings.html").read_text("utf-8")
    assert "fresh.py" in page
    assert "walking.py" not in page
    assert main(["report", str(walking), "-o", str(tmp_path / "whole"), *words]) == 2
    assert "no finished run" in capsys.readouterr().err


def test_no_run_of_changed_files_is_told(walking, capsys):
    check(walking, capsys, code=1)
    assert main(["report", str(walking), "--changed", "-q"]) == 2
    assert "Run `roslens check --changed" in capsys.readouterr().err


def test_a_tag_that_no_rule_has_is_refused(walking, capsys):
    assert main(["check", str(walking), "-q", "--tag", "metrics and complexty"]) == 2
    assert "no rule has the tag 'complexty'" in capsys.readouterr().err
    # Tags of rules that are off here are known, and nothing has them.
    assert check(walking, capsys, "--tag", "node or misra-cpp-2023", code=0)["findings"] == []


def test_a_model_by_its_path_from_the_current_folder(walking, capsys, tmp_path, monkeypatch):
    (tmp_path / "own.yaml").write_text("kind: quality model\nname: own\nextends: [ros]\nwithout: [calls]\n")
    monkeypatch.chdir(tmp_path)
    report = check(walking, capsys, "--model", "./own.yaml", code=1)
    assert {one["rule"].partition(".")[0] for one in report["findings"]} == {"own"}


def test_changed_outside_of_a_repository_is_told(talking, capsys):
    assert main(["check", str(talking), "-q", "--changed"]) == 2
    assert "git repository" in capsys.readouterr().err


def gate(root, text):
    (root / "roslens.toml").write_text(f"{LIMITS_ONLY}[gate]\n{text}\n")
    return ["check", str(root), "--jobs", "1", "-q", "--no-graph"]


def test_the_gate_decides_and_says_why(walking, capsys):
    words = gate(walking, "notes = 0\nnew_notes = 0\ncomment_ratio_of_new_code = 20")
    assert main([*words, "--baseline", "HEAD"]) == 1
    out = capsys.readouterr().out
    assert "Gate is broken: " in out
    assert "Gate holds: 0 new notes, at most 0" in out
    assert "Gate holds: comment ratio of new code: there is no such code" in out
    words = gate(walking, "new_notes = 0")
    assert main([*words, "--baseline", "HEAD"]) == 0
    add_finding(walking)
    assert main([*words, "--baseline", "HEAD"]) == 1
    (walking / "talk/talk/fresh.py").write_text("x = 1\n")
    words = gate(walking, "comment_ratio_of_new_code = 20")
    assert main([*words, "--baseline", "HEAD"]) == 1
    assert "comment ratio of new code 0 %, at least 20 %" in capsys.readouterr().out


def test_a_gate_that_cannot_be_told_is_not_passed(walking, capsys, tmp_path):
    words = gate(walking, "new_errors = 0")
    assert main(words) == 3
    assert "Give --baseline REV, RUN or a JSON report" in " ".join(capsys.readouterr().out.split())
    kept = tmp_path / "kept.sarif"
    main([*words, "-o", str(kept)])
    assert main([*words, "--baseline", str(kept)]) == 0
    assert main([*gate(walking, "comment_ratio_of_new_code = 1"), "--baseline", str(kept)]) == 3


@pytest.mark.parametrize(
    ("text", "said"), [("", "asks for nothing"), ("new_error = 0", "new_errors"), ('errors = "x"', "int")]
)
def test_a_wrong_gate_is_told(walking, capsys, text, said):
    assert main(gate(walking, text)) == 2
    assert said in capsys.readouterr().err


def test_what_does_not_parse_counts_where_it_changed(walking, capsys):
    (walking / "talk/talk/broken.py").write_text("def f(:\n    return 1 +\n")
    git(walking, "add", ".")
    git(walking, "commit", "-qm", "broken")
    (walking / "talk/talk/fresh.py").write_text("x = 1\n")
    assert check(walking, capsys, "--changed", "--fail-on", "never", code=0)["failures"] == []
    assert len(check(walking, capsys, "--changed", "HEAD~1", "--fail-on", "never", code=3)["failures"]) == 1


def first_on_the_page(root, folder):
    assert main(["report", str(root), "-o", str(folder), "--no-graph", "-q", "--jobs", "1"]) == 0
    for page in folder.rglob("*.html"):
        assert not re.search(r" x\)\s*<span class=.quiet.>\(", page.read_text("utf-8")), f"{page.name}: an excess twice"
    rows = (folder / "index.html").read_text("utf-8").partition("<h2>Fix first</h2>")[2].partition("</ol>")[0]
    links = [row.partition('class="go"')[2] for row in rows.split("<li>")[1:]]
    named = [link.partition("<code>")[2].partition("</code>")[0] for link in links]
    return [("chip" in row, rule) for row, rule in zip(rows.split("<li>")[1:], named, strict=True)]


def first_in_the_terminal(text):
    rows = text.partition("Fix first")[2].partition("\n\n")[0].splitlines()
    facts = [one.strip().split(" \N{MIDDLE DOT} ") for one in rows]
    rules = [parts[1] for parts in facts if len(parts) > 1 and ", " in parts[0]]
    return [(one.startswith("new: "), one.removeprefix("new: ")) for one in rules]


def test_pages_fix_first_what_the_terminal_does(walking, capsys, tmp_path_factory):
    (walking / "roslens.toml").write_text(
        "[rules]\nprofiles = []\nenable = ['python.is_literal', 'python.assert_tuple']\n"
    )
    tangled = "def {}(step):\n    assert (step, 'no step')\n    return step is 1\n\n\n"
    with (walking / "talk/talk/walking.py").open("a") as stream:
        stream.write(tangled.format("known"))
    git(walking, "commit", "-qam", "second")
    with (walking / "talk/talk/walking.py").open("a") as stream:
        stream.write(tangled.format("added"))
    text = check(walking, capsys, "--baseline", "HEAD", code=1, form="text")
    assert "2 new findings\n" in text
    reported = first_in_the_terminal(text)
    assert [one for one, _ in reported] == [False, False]
    shown = first_on_the_page(walking, tmp_path_factory.mktemp("compared") / "out")
    assert shown == [(True, rule) for _, rule in reported] + reported
    reported = first_in_the_terminal(check(walking, capsys, code=1, form="text"))
    assert reported
    assert not any(new for new, _ in reported)
    assert first_on_the_page(walking, tmp_path_factory.mktemp("alone") / "out") == reported


def looked(root, capsys, *more, graph=True):
    words = ["check", str(root), "--format", "json", "--jobs", "1", "-q", "--fail-on", "never", *more]
    assert main(words if graph else [*words, "--no-graph"]) == 0
    report = json.loads(capsys.readouterr().out)
    return [one for one in report["findings"] if one["rule"].startswith("graph.")], report


@pytest.mark.parametrize("kept", ["last", "report.json", "report.sarif"])
def test_findings_of_graphs_are_not_new_since_a_baseline_without_graphs(walking, capsys, kept):
    name = kept if kept == "last" else str(walking / kept)
    more = () if kept == "last" else ("--format", f"{Path(kept).suffix[1:]}={name}")
    looked(walking, capsys, *more, graph=False)
    found, _ = looked(walking, capsys, "--baseline", name)
    assert {one["rule"]: one["new"] for one in found} == {"graph.qos": False}
    assert main(["check", str(walking), "--jobs", "1", "-q", "--baseline", name, "--new-only"]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "which has no computation graphs: theirs are not compared" in out


@pytest.mark.parametrize("kept", ["last", "report.json", "report.sarif"])
def test_findings_of_graphs_are_compared_with_those_of_a_baseline_that_looked_at_graphs(walking, capsys, kept):
    nodes = walking / "talk/talk/nodes.py"
    wrong = nodes.read_text()
    nodes.write_text(wrong.replace("qos_profile_sensor_data)", "10)"))
    name = kept if kept == "last" else str(walking / kept)
    more = () if kept == "last" else ("--format", f"{Path(kept).suffix[1:]}={name}")
    assert looked(walking, capsys, *more)[0] == []
    nodes.write_text(wrong)
    found, _ = looked(walking, capsys, "--baseline", name)
    assert {one["rule"]: one["new"] for one in found} == {"graph.qos": True}


def test_findings_of_graphs_are_not_gone_where_no_graph_is_looked_at(walking, capsys):
    assert len(looked(walking, capsys)[0]) == 1
    assert main(["check", str(walking), "--jobs", "1", "-q", "--no-graph", "--baseline", "last"]) == 0
    assert "New since run 1: nothing; gone: 0" in capsys.readouterr().out


def test_a_revision_is_looked_at_with_its_graphs(walking, capsys):
    assert {one["new"] for one in looked(walking, capsys, "--baseline", "HEAD")[0]} == {False}
