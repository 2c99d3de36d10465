"""What a user does with a workspace, from the first check on."""

from __future__ import annotations

import json
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

pytestmark = pytest.mark.timed

KNOTTY = (
    "// one\n// two\n// three\n// four\n// five\n// six\nint knotty(int a) {\n  int n = 0;\n"
    + "".join(f"  {'else ' if number else ''}if (a == {number}) n += {number};\n" for number in range(16))
    + "  return n;\n}\n"
)
BRANCHING = KNOTTY.replace("  else if", "  if")
"""It breaks the limit on static paths, too."""
CC_RULE = "ros.cyclomatic_complexity.max"


def report_of(roslens, robot, *more: str):
    return roslens("check", robot.root, "--format", "json", "--jobs", "1", *more).json()


def test_text_says_what_is_wrong_and_what_to_do_next(roslens, robot):
    robot.package("arm", knotty__cpp=KNOTTY)
    done = roslens("check", robot.root, "--jobs", "1")
    assert done.code == 0
    assert "arm" in done.out
    assert CC_RULE in done.out
    assert "roslens" in done.out.splitlines()[-1]


def test_fail_on_decides_the_exit_code(roslens, robot):
    robot.package("arm", knotty__cpp=KNOTTY)
    # Limits of the ROS model are warnings where it is asked for, and notes by default.
    strict = ("check", robot.root, "--model", "ros", "--fail-on")
    assert roslens(*strict, "warning").code == 1
    assert roslens(*strict, "never").code == 0
    assert roslens(*strict, "warning", "--tag", "nesting").code == 0
    assert roslens("check", robot.root, "--fail-on", "warning").code == 0
    assert roslens("check", robot.root, "--fail-on", "note").code == 1


def test_a_finding_carries_value_bound_and_model(roslens, robot):
    robot.package("arm", knotty__cpp=KNOTTY)
    (finding,) = [found for found in report_of(roslens, robot)["findings"] if found["rule"] == CC_RULE]
    assert (finding["value"], finding["bound"], finding["model"]) == (17, 15, "ros")
    assert (finding["path"], finding["line"]) == ("arm/src/knotty.cpp", 7)


def test_a_fingerprint_survives_that_code_moves(roslens, robot):
    path = robot.package("arm", knotty__cpp=KNOTTY) / "src" / "knotty.cpp"
    (before,) = [found for found in report_of(roslens, robot)["findings"] if found["rule"] == CC_RULE]
    path.write_text("// a new first line\n\n" + KNOTTY)
    (after,) = [found for found in report_of(roslens, robot)["findings"] if found["rule"] == CC_RULE]
    assert (after["line"], after["fingerprint"]) == (before["line"] + 2, before["fingerprint"])


def test_two_runs_give_the_same_bytes_whatever_the_number_of_processes(roslens, robot):
    robot.package("arm", knotty__cpp=KNOTTY)
    robot.package("base", "<depend>arm</depend>", a__py="def f(x):\n    return x\n")

    def text(jobs: str) -> str:
        found = roslens("check", robot.root, "--format", "json", "--jobs", jobs, "--no-store", "--no-cache").json()
        for key in ("started", "seconds"):
            found["run"].pop(key, None)
        return json.dumps(found)

    assert text("1") == text("2") == text("1")


def test_the_second_run_on_an_unchanged_tree_is_the_first(roslens, robot):
    robot.package("arm", knotty__cpp=KNOTTY)
    first = roslens("check", robot.root)
    second = roslens("check", robot.root)
    assert "nothing changed" in second.err
    assert second.out == first.out
    with closing(sqlite3.connect(robot.root / ".roslens" / "store.sqlite")) as store, store:
        assert store.execute("SELECT count(*) FROM run").fetchone() == (1,)


def test_only_the_changed_package_is_measured_again(roslens, robot):
    robot.package("arm", knotty__cpp=KNOTTY)
    path = robot.package("base") / "src" / "one.cpp"
    roslens("check", robot.root)
    path.write_text("int changed() { return 3; }\n")
    assert "1 of 2 packages measured" in roslens("check", robot.root).err


def test_test_code_is_visible_but_does_not_fail_the_gate(roslens, robot):
    folder = robot.package("arm")
    (folder / "test").mkdir()
    (folder / "test" / "test_knotty.cpp").write_text(KNOTTY)
    strict = ("check", robot.root, "--model", "ros", "--fail-on", "warning")
    done = roslens(*strict, "--format", "json")
    (finding,) = [found for found in done.json()["findings"] if found["rule"] == CC_RULE]
    assert (done.code, finding["gated"]) == (0, False)
    (robot.root / "roslens.toml").write_text('gate_roles = ["own", "test"]\n')
    assert roslens(*strict).code == 1


def test_a_suppression_hides_a_finding(roslens, robot):
    robot.package(
        "arm",
        knotty__cpp=KNOTTY.replace("int knotty", f"// roslens: ignore-next-line[{CC_RULE}] on purpose\nint knotty"),
    )
    assert not [found for found in report_of(roslens, robot)["findings"] if found["rule"] == CC_RULE]


def test_more_models_judge_by_more_bounds(roslens, robot):
    robot.package("arm", knotty__cpp=KNOTTY)
    rules = {found["rule"] for found in report_of(roslens, robot, "--model", "ros", "--model", "his")["findings"]}
    assert {CC_RULE, "his.cyclomatic_complexity.max"} <= rules


def test_the_counts_of_findings_are_quantities(roslens, robot):
    robot.package("arm", knotty__cpp=BRANCHING)
    report = roslens("check", robot.root, "--model", "ros", "--format", "json").json()
    (package,) = report["packages"]
    assert [one["rule"] for one in report["findings"]] == ["ros.function_limits"]
    assert (package["metrics"]["rqv"], package["metrics"]["rcv"]) == (2, 0)


def test_dependents_are_counted_over_the_workspace(roslens, robot):
    robot.package("arm")
    robot.package("base", "<depend>arm</depend>")
    found = {package["name"]: package["metrics"] for package in report_of(roslens, robot)["packages"]}
    assert (found["arm"]["dependents"], found["base"]["dependents"]) == (1, 0)


def test_nothing_is_kept_when_nothing_shall_be(roslens, robot):
    robot.package("arm")
    roslens("check", robot.root, "--no-store", "--no-cache")
    assert not (robot.root / ".roslens").exists()


def test_output_goes_where_it_is_told(roslens, robot, tmp_path):
    robot.package("arm", knotty__cpp=KNOTTY)
    done = roslens("check", robot.root, "--format", "json", "-o", tmp_path / "out" / "report.json", "-q")
    assert (done.out, done.err) == ("", "")
    assert json.loads((tmp_path / "out" / "report.json").read_text())["schema"]
    roslens("check", robot.root, "--format", "csv", "-o", tmp_path / "tables")
    assert (tmp_path / "tables" / "packages.csv").read_text().startswith("id,")


def test_explain_knows_rules_quantities_and_models(roslens):
    for wanted, says in ((CC_RULE, "15"), ("cyclomatic_complexity", "McCabe"), ("his", "static_paths")):
        done = roslens("explain", wanted)
        assert done.code == 0
        assert says in done.out, done.out
    near = roslens("explain", "cyclomatic_complexty")
    assert near.code == 2
    assert "cyclomatic_complexity" in near.err


def test_init_writes_what_check_reads(roslens, robot):
    robot.package("arm")
    assert roslens("init", robot.root).code == 0
    assert roslens("check", robot.root).code == 0
    assert roslens("init", robot.root).code == 2
    assert roslens("init", robot.root, "--force").code == 0


def test_doctor_is_content(roslens, robot):
    robot.package("arm")
    roslens("check", robot.root)
    done = roslens("doctor", robot.root)
    assert done.code == 0, done.out
    assert "1 complete runs" in done.out


def test_clean_undoes(roslens, robot):
    robot.package("arm")
    roslens("check", robot.root)
    assert roslens("clean", robot.root).code == 0
    assert roslens("check", robot.root).code == 0
    assert roslens("clean", robot.root, "--all").code == 0
    assert not (robot.root / ".roslens").exists()


@pytest.mark.parametrize("shell", ["bash", "zsh", "tcsh"])
def test_completion_knows_the_verbs(roslens, shell: str):
    done = roslens("completion", shell)
    assert done.code == 0
    assert "check" in done.out


def test_help_has_examples_everywhere(roslens):
    assert "exit codes" in roslens("--help").out
    for verb in ("check", "report", "serve", "explain", "plugins", "trust", "init", "doctor", "completion", "clean"):
        assert "examples:" in roslens(verb, "--help").out


def test_report_writes_pages_and_one_file(roslens, robot, tmp_path):
    robot.package("arm", knotty__cpp=KNOTTY)
    roslens("check", robot.root)
    assert roslens("report", robot.root, "-o", tmp_path / "site").code == 0
    assert "arm" in (tmp_path / "site" / "index.html").read_text()
    assert roslens("report", robot.root, "--single-file", tmp_path / "one.html").code == 0
    assert CC_RULE in (tmp_path / "one.html").read_text()


def test_what_a_haros_plugin_exports_is_kept(roslens, robot):
    robot.package("pack", a__py="x = 1\n")
    plugin = Path(__file__).parents[1] / "fixtures" / "plugins" / "haros_plugin_hooks"
    (robot.root / "roslens.toml").write_text(f"plugins = [{str(plugin)!r}]\n")
    roslens("check", robot.root, "--fail-on", "never", "--trust")
    assert (robot.root / ".roslens" / "artifacts" / "haros_plugin_hooks" / "made.txt").is_file()
