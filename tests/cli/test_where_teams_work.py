"""Where teams start roslens besides a terminal: pre-commit, GitHub, colcon, ros2, ament and catkin."""

import argparse
import re
import shlex
import sys
import types
from importlib import import_module
from pathlib import Path

import pytest
import tomli
import yaml

from roslens.cli.main import parser
from roslens.source.workspace.manifest import read_manifest

ROOT = Path(__file__).parents[2]
PROJECT = (ROOT / "pyproject.toml").read_text("utf-8")


def test_the_hook_is_a_command_that_there_is():
    hooks = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))
    for hook, fixes in zip(hooks, (False, True), strict=True):
        program, *words = shlex.split(hook["entry"])
        assert program == "roslens"
        assert hook["id"] == ("roslens-fix" if fixes else "roslens")
        options = parser().parse_args(words)
        assert (options.verb, options.changed, options.fail_on) == ("check", "HEAD", "warning")
        assert options.fix is fixes
        assert hook["pass_filenames"] is False


@pytest.fixture
def help_of_check(capsys):
    with pytest.raises(SystemExit):
        parser().parse_args(["check", "--help"])
    return capsys.readouterr().out


def test_no_input_of_the_action_is_run_as_a_command(help_of_check):
    action = yaml.safe_load((ROOT / "action.yml").read_text("utf-8"))
    inputs = set(action["inputs"])
    seen = set()
    for step in action["runs"]["steps"]:
        assert "${{" not in step["run"]
        for value in step["env"].values():
            seen.update(re.findall(r"inputs\.([\w-]+)", value))
    assert seen == inputs
    text = action["runs"]["steps"][1]["run"]
    for option in re.findall(r"(?<=\()--[a-z-]+", text):
        assert option in help_of_check


def entry(group, name):
    return tomli.loads(PROJECT)["project"]["entry-points"][group][name].split(":")


@pytest.fixture
def module(monkeypatch):
    """Return a function that puts a module of the given content where imports find it."""

    def put(name, **content):
        made = types.ModuleType(name)
        made.__dict__.update(content)
        monkeypatch.setitem(sys.modules, name, made)

    for name in ("colcon_core", "ros2cli", "roslens.cli.colcon_verb", "roslens.cli.ros2_command"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    yield put
    for name in ("roslens.cli.colcon_verb", "roslens.cli.ros2_command"):
        sys.modules.pop(name, None)


class Point:
    EXTENSION_POINT_VERSION = "1.0"


def test_colcon_roslens(module, talking, monkeypatch, capsys):
    module("colcon_core")
    module("colcon_core.plugin_system", satisfies_version=lambda _version, _wanted: None)
    module("colcon_core.verb", VerbExtensionPoint=Point)
    name, verb = entry("colcon_core.verb", "roslens")
    made = getattr(import_module(name), verb)()
    words = argparse.ArgumentParser()
    made.add_arguments(parser=words)
    (talking / "src").mkdir()
    (talking / "talk").rename(talking / "src/talk")
    monkeypatch.chdir(talking)
    given = words.parse_args(["--no-store", "--no-cache", "-q", "--jobs", "1", "--fail-on", "never"])
    assert made.main(context=types.SimpleNamespace(args=given)) in {0, 3}
    assert capsys.readouterr().out.startswith("src · 1 package")
    assert made.main(context=types.SimpleNamespace(args=words.parse_args(["nowhere"]))) == 2


def test_ros2_lens(module, capsys):
    module("ros2cli")
    module("ros2cli.command", CommandExtension=object)
    name, command = entry("ros2cli.command", "lens")
    made = getattr(import_module(name), command)()
    words = argparse.ArgumentParser()
    made.add_arguments(words, "ros2 lens", argv=[])
    assert made.main(parser=words, args=words.parse_args(["explain", "cyclomatic_complexity"])) == 0
    assert "Cyclomatic complexity" in capsys.readouterr().out
    with pytest.raises(SystemExit):
        made.main(parser=words, args=words.parse_args([]))
    assert "roslens" in capsys.readouterr().out


def test_nothing_of_colcon_or_ros2cli_is_imported_otherwise():
    users = [
        path.name
        for path in (ROOT / "src/roslens").rglob("*.py")
        if re.search(r"^\s*(?:from|import) (?:colcon_core|ros2cli)", path.read_text("utf-8"), re.MULTILINE)
    ]
    assert sorted(users) == ["colcon_verb.py", "ros2_command.py"]


@pytest.mark.parametrize(("version", "build_type"), [("1", "catkin"), ("2", "ament_cmake")])
def test_the_package_is_one_of_both_generations(version, build_type):
    content = (ROOT / "ros/ament_cmake_roslens/package.xml").read_bytes()
    package, failures = read_manifest(content, "ament_cmake_roslens/package.xml", {"ROS_VERSION": version})
    assert (package.name, package.build_type, failures) == ("ament_cmake_roslens", build_type, ())


@pytest.mark.parametrize("name", ["ament_roslens", "catkin_add_roslens_test"])
def test_the_functions_run_a_command_that_there_is(name, help_of_check):
    text = (ROOT / f"ros/ament_cmake_roslens/cmake/{name}.cmake").read_text("utf-8")
    options = {
        word for line in text.splitlines() if not line.startswith("#") for word in re.findall(r"(?<=\s)--[a-z-]+", line)
    }
    assert options >= {"--no-store", "--no-cache", "--format", "--fail-on"}
    assert all(option in help_of_check for option in options)
