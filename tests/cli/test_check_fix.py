"""``roslens check --fix``, ``--diff`` and ``--undo-fix`` on a small workspace."""

import json
import subprocess

import pytest

from roslens.cli.main import main

MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>arm</name>
  <version>1.0.0</version>
  <description>An arm.</description>
  <maintainer email="ada@example.org">Ada</maintainer>
  <license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <depend>rclcpp</depend>
  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"""
CMAKE = """\
cmake_minimum_required(VERSION 3.16)
project(arm)
find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
find_package(sensor_msgs REQUIRED)
ament_package()
"""
HEADER = """\
// Copyright 2026 Ada

#include <string>

struct Base
{
  virtual ~Base() = default;
  virtual void stop() = 0;
};

struct Arm : Base
{
  virtual void stop();
};
"""
SOURCE = """\
#include <sensor_msgs/msg/joint_state.hpp>

void run()
{
  try {
    register int i = 0;
    step(i);
  } catch (std::exception e) {
    log(e.what());
  }
}
"""


@pytest.fixture
def arm(tmp_path, monkeypatch):
    root = tmp_path / "ws"
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE,
        "include/arm/arm.hpp": HEADER,
        "src/arm.cpp": SOURCE,
    }
    for path, text in files.items():
        (root / "arm" / path).parent.mkdir(parents=True, exist_ok=True)
        (root / "arm" / path).write_text(text)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.chdir(root)
    return root


def check(capfd, *words, code):
    assert main(["check", "--jobs", "1", "--fail-on", "never", *words]) == code, capfd.readouterr()
    return capfd.readouterr()


def tree(root):
    return {path: path.read_bytes() for path in sorted((root / "arm").rglob("*")) if path.is_file()}


def fixable(capfd):
    report = json.loads(check(capfd, "--format", "json", code=0).out)
    return {one["rule"] for one in report["findings"] if "fix" in one and one["gated"]}


def test_it_mends_what_it_said_it_would_and_takes_it_back(arm, capfd):
    before = tree(arm)
    assert "5 of these can be fixed safely: roslens check --fix" in check(capfd, code=0).out
    reported = check(capfd, "--diff", code=1)
    assert tree(arm) == before, "--diff changes nothing"
    assert "would fix 5 of 5 findings with a fix in 3 files" in reported.err
    assert fixable(capfd) == {
        "cpp.guard",
        "cpp.override",
        "cpp.register",
        "cpp.catch_by_value",
        "package.undeclared_dependency",
    }
    done = check(capfd, "--fix", code=0)
    assert "fixed 5 of 5 findings with a fix in 3 files" in done.err
    assert "--undo-fix" in done.err
    assert "arm: " in done.out or "arm" in done.out
    assert (arm / "arm/include/arm/arm.hpp").read_text() == HEADER.replace(
        "#include <string>", "#ifndef ARM__ARM_HPP_\n#define ARM__ARM_HPP_\n\n#include <string>"
    ).replace("  virtual void stop();", "  void stop() override;") + "\n#endif  // ARM__ARM_HPP_\n"
    assert "<depend>rclcpp</depend>\n  <depend>sensor_msgs</depend>\n" in (arm / "arm/package.xml").read_text()
    assert "catch (const std::exception& e)" in (arm / "arm/src/arm.cpp").read_text()
    after = tree(arm)
    # What the diff said is what was done.
    for path, content in before.items():
        path.write_bytes(content)
    subprocess.run(["git", "apply", "-"], input=reported.out.encode(), cwd=arm, check=True)
    assert tree(arm) == after
    # A second time there is nothing left, and what was done can still be taken back.
    done = check(capfd, "--fix", code=0)
    assert "nothing to fix" in done.err
    assert "can be fixed" not in done.out
    assert check(capfd, "--diff", code=0).out == ""
    assert "3 files as before the last fix" in check(capfd, "--undo-fix", code=0).err
    assert tree(arm) == before
    assert "no fix to undo" in check(capfd, "--undo-fix", code=2).err


def test_what_is_silenced_accepted_or_of_another_rule_is_left(arm, capfd):
    (arm / "roslens.toml").write_text('[[ignore]]\nrules = ["cpp.guard"]\nreason = "read once"\n')
    source = arm / "arm/src/arm.cpp"
    source.write_text(SOURCE.replace("int i = 0;", "int i = 0;  // roslens: ignore[cpp.register] old compiler"))
    out = check(capfd, "--diff", "--fix-rule", "cpp.*", code=1).out
    assert "-  virtual void stop();" in out
    assert "catch (const" in out
    assert not {"-    register", "#ifndef", "sensor_msgs</depend>"} & set(out.split("\n"))
    assert "register" not in "".join(line for line in out.splitlines() if line[:1] in "+-")
    assert "depend" not in out


def test_files_of_others_are_left(arm, capfd):
    (arm / "roslens.toml").write_text('[workspace]\nvendored = ["arm/include"]\n')
    reported = check(capfd, "--diff", code=1)
    assert "arm.hpp" not in reported.out
    assert "would fix 3 of 3" in reported.err


def test_a_read_only_file_is_a_failure_and_the_others_are_mended(arm, capfd):
    (arm / "arm/src/arm.cpp").chmod(0o444)
    done = check(capfd, "--fix", code=3)
    assert "fixed 3 of 5 findings with a fix in 2 files; 2 not: 2 because its file: it is read-only" in done.err
    assert "arm/src/arm.cpp: it is read-only" in done.out
    assert (arm / "arm/src/arm.cpp").read_text() == SOURCE
    assert "override" in (arm / "arm/include/arm/arm.hpp").read_text()


def test_only_what_changed_is_mended(arm, capfd):
    for words in (["init", "-q"], ["add", "."], ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "x"]):
        subprocess.run(["git", *words], cwd=arm, check=True)
    (arm / "arm/src/arm.cpp").write_text(SOURCE + "// more\n")
    check(capfd, "--fix", "--changed", code=0)
    changed = subprocess.run(["git", "diff", "--name-only"], cwd=arm, check=True, capture_output=True, text=True).stdout
    assert "arm/src/arm.cpp" in changed.split()
    assert "arm/include/arm/arm.hpp" not in changed.split()


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["--fix", "--diff"], "--fix with --diff"),
        (["--diff", "--undo-fix"], "--diff with --undo-fix"),
        (["--fix", "--watch"], "--fix with --watch"),
        (["--fix-rule", "cpp.guard"], "--fix-rule without --fix or --diff"),
        (["--diff", "-o", "x.sarif"], "--diff with --format or -o"),
    ],
)
def test_options_that_contradict_each_other_are_refused(arm, capfd, words, text):
    assert text in check(capfd, *words, code=2).err


def test_a_way_back_that_cannot_be_kept_stops_the_fix(arm, capfd):
    before = tree(arm)
    (arm / ".roslens").mkdir()
    check(capfd, code=0)
    (arm / ".roslens/last-fix.json.part").mkdir()
    assert "nothing is fixed: the way back cannot be kept" in check(capfd, "--fix", code=2).err
    assert tree(arm) == before
    assert "fixed 5 of 5" in check(capfd, "--fix", "--no-store", code=0).err


def test_the_summary_is_not_told_where_it_is_to_be_quiet(arm, capfd):
    assert check(capfd, "--fix", "-q", code=0).err == ""
