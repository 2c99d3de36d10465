"""No canary of a hostile workspace sings: not before trust, nor for a tool that the user names or a trusted one."""

import json
import os
from pathlib import Path

import pytest

from canaries.canary_workspace import CanaryWorkspace, text_of_settings
from roslens.cli.main import main
from roslens.source.tools.running.programs import find_program
from roslens.source.tools.table import tool_named
from roslens.source.tools.used import TOOLS

WHEELS = Path(__file__).parents[2] / "build" / "ros2" / "bin"
ASKED = tuple(name for name in TOOLS if name != "ament_xmllint")  # which asks the net


@pytest.fixture(scope="module")
def hostile(tmp_path_factory):
    """Return the workspace."""
    return CanaryWorkspace(tmp_path_factory.mktemp("canaries"))


@pytest.fixture
def alone(hostile, monkeypatch, tmp_path):
    """Give each test the workspace without a configuration, a user of its own, and the workspace as current folder.

    The user's search paths have empty entries, as ``export PATH=$PATH:/opt`` leaves them where there was none, and ROS
    knows the workspace, as it does where its setup file was sourced.
    """
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "user"))
    monkeypatch.setenv("PATH", os.pathsep.join((os.environ["PATH"], str(WHEELS))))
    for name in ("PYTHONPATH", "LD_LIBRARY_PATH"):
        monkeypatch.setenv(name, os.pathsep + os.environ.get(name, "/nowhere"))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(hostile.root))
    monkeypatch.chdir(hostile.root)
    (hostile.root / "roslens.toml").unlink(missing_ok=True)
    hostile.sing()
    return hostile


def check(hostile, capfd, *words):
    """Check the workspace; return the report."""
    main(["check", str(hostile.root), "--jobs", "1", "--format", "json", "--no-store", "--no-cache", *words])
    return json.loads(capfd.readouterr().out)


def installed(name, root):
    """Tell whether a tool is there to be tried."""
    return find_program(tool_named(name).program, str(root)) is not None


def test_nothing_that_a_workspace_configures_is_started_before_trust(alone, capfd):
    (alone.root / "roslens.toml").write_text(text_of_settings(TOOLS, alone.root))
    before = alone.files()
    report = check(alone, capfd)
    assert alone.sing() == []
    assert alone.changed(before) == []
    said = {failure["tool"]: failure["what"] for failure in report["failures"]}
    assert {*TOOLS, "cccc", "own"} <= {*said}, "each is named as not trusted"
    assert not set(report["run"]["tools"]) & {*TOOLS, "own"}, "none ran"


@pytest.mark.parametrize("name", ASKED)
def test_a_tool_that_the_user_names_runs_nothing_of_the_workspace(name, alone, capfd):
    if not installed(name, alone.root):
        pytest.skip(f"{name} is not installed; {tool_named(name).get}")
    (alone.root / "roslens.toml").write_text(text_of_settings(TOOLS, alone.root))
    before = alone.files()
    report = check(alone, capfd, "--tools", name)
    assert alone.sing() == []
    assert alone.changed(before) == []
    said = [failure["what"] for failure in report["failures"] if failure["tool"] == name]
    if name == "clang_format":  # which has no layout without settings
        assert len(said) == 1, said
    else:
        assert name in report["run"]["tools"]
        assert said == []


@pytest.mark.parametrize("name", ASKED)
def test_without_a_sandbox_a_tool_that_the_user_names_runs_nothing_either(name, alone, capfd, monkeypatch):
    if not installed(name, alone.root):
        pytest.skip(f"{name} is not installed; {tool_named(name).get}")
    monkeypatch.setattr("roslens.source.tools.running.run_tool.sandbox_kind", lambda: "")
    before = alone.files()
    check(alone, capfd, "--tools", name)
    assert alone.sing() == []
    assert alone.changed(before) == []


@pytest.mark.parametrize("name", ASKED)
def test_a_trusted_workspace_runs_no_module_or_program_beside_the_code(name, alone, capfd):
    if not installed(name, alone.root):
        pytest.skip(f"{name} is not installed; {tool_named(name).get}")
    text = f"[tools]\nuse = [{name!r}]\n" + ("[options.cppcheck]\nmisra = true\n" if name == "cppcheck" else "")
    (alone.root / "roslens.toml").write_text(text)
    before = alone.files()
    check(alone, capfd, "--trust")
    assert alone.sing() == []
    assert alone.changed(before) == []
