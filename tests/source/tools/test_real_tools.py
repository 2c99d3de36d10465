"""Tools that are installed find in the recorded sources what they found when that was recorded, in any version."""

import json
import os
import shutil
from pathlib import Path

import pytest
from recorded_tools import SOURCES

from roslens.cli.main import main
from roslens.source.tools.running.programs import find_program
from roslens.source.tools.table import tool_named
from roslens.source.tools.used import TOOLS

pytestmark = pytest.mark.real

WHEELS = Path(__file__).parents[3] / "build" / "ros2" / "bin"

MANIFEST = """<package format="2"><name>arm</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.org">A</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend></package>
"""

FINDS = {
    "ament_copyright": ("arm/sample.cpp", "copyright"),
    "ament_flake8": ("arm/sample.py", "F821"),
    "ament_lint_cmake": ("cat/CMakeLists.txt", "whitespace/extra"),
    "ament_pep257": ("arm/sample.py", "D400"),
    "catkin_lint": ("cat/CMakeLists.txt", "missing_file"),
    "clang_format": ("arm/sample.cpp", "violation"),
    "clang_tidy": ("arm/whole.cpp", "clang-analyzer-core.DivideZero"),
    "cppcheck": ("arm/sample.cpp", "zerodiv"),
    "cpplint": ("arm/sample.hpp", "runtime/explicit"),
    "pylint": ("arm/sample.py", "undefined-variable"),
    "ruff": ("arm/sample.py", "F821"),
}


SILENT = {
    ".catkin_lint": "[catkin_lint]\nseverity_level = 0\n[*]\nmissing_file = ignore\n",
    ".clang-tidy": "Checks: '-*,llvm-*'\n",
    ".flake8": "[flake8]\nexclude = *\nextend-ignore = F\n",
    ".pydocstyle": "[pydocstyle]\nmatch = nothing\nadd-ignore = D400\n",
    ".pylintrc": "[MAIN]\nignore-patterns = .*\ndisable = all\n",
    ".ruff.toml": "exclude = ['*']\nlint.ignore = ['F']\n",
    "CPPLINT.cfg": "set noparent\nexclude_files=.*\nfilter=-\n",
    "pylintrc": "[MAIN]\nignore-patterns = .*\ndisable = all\n",
    "pyproject.toml": "[tool.ruff]\nexclude = ['*']\n[tool.pydocstyle]\nmatch = 'nothing'\n",
    "setup.cfg": "[flake8]\nexclude = *\n[pydocstyle]\nmatch = nothing\n[pylint.main]\nignore-patterns = .*\n",
    "tox.ini": "[flake8]\nexclude = *\n[pydocstyle]\nmatch = nothing\n",
}
"""Settings files that keep tools from reporting anything, each in the place where a tool looks for it."""

tried_tools = pytest.mark.parametrize("name", [name for name in TOOLS if name != "ament_xmllint"])  # which asks the net


@pytest.fixture
def root(name, tmp_path, monkeypatch):
    """Return a workspace with the recorded sources, for a tool that is installed."""
    monkeypatch.setenv("PATH", os.pathsep.join((os.environ["PATH"], str(WHEELS))))
    tool = tool_named(name)
    if find_program(tool.program, str(tmp_path)) is None:
        pytest.skip(f"{tool.program} is not installed; {tool.get}")
    root = tmp_path / "ws"
    shutil.copytree(SOURCES, root / "arm", ignore=shutil.ignore_patterns("cat"))
    shutil.copytree(SOURCES / "cat", root / "cat")
    (root / "arm" / "package.xml").write_text(MANIFEST)
    (root / ".clang-format").write_text("BasedOnStyle: Google\n")
    source = root / "arm" / "whole.cpp"
    entry = {"directory": str(root), "command": f"c++ -std=c++17 -c {source}", "file": str(source)}
    Path(root / "compile_commands.json").write_text(json.dumps([entry]))
    for number in range(20):
        shutil.copy(root / "arm" / "sample.py", root / "arm" / f"sample_{number}.py")
    return root


@tried_tools
def test_a_tool_that_is_installed_is_understood(name, root, capfd):
    (root / "roslens.toml").write_text(f'[tools]\nuse = ["{name}"]\nlayout = "each"\n')
    main(["check", str(root), "--jobs", "1", "--format", "json", "--no-store", "--no-cache", "--trust"])
    report = json.loads(capfd.readouterr().out)
    # A catkin package without catkin is the tool's own trouble; what is asked is that it was run and understood.
    assert not [failure["what"] for failure in report["failures"] if "was not run" in failure["what"]]
    assert failures_of(name, report) == []
    path, check = FINDS[name]
    assert (path, f"{name}.{check}") in found_in(report)


@tried_tools
def test_settings_of_the_workspace_silence_no_tool_before_they_are_trusted(name, root, capfd, monkeypatch):
    if name == "clang_format":
        pytest.skip("clang_format has no layout without settings")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(root))  # where catkin_lint looks for settings
    for place in (root, root / "arm", root / "cat"):
        for file, text in SILENT.items():
            (place / file).write_text(text)
    words = ["--jobs", "1", "--format", "json", "--no-store", "--no-cache"]
    main(["check", str(root), "--tools", name, *words])
    report = json.loads(capfd.readouterr().out)
    assert failures_of(name, report) == []
    path, check = FINDS[name]
    assert (path, f"{name}.{check}") in found_in(report)


def failures_of(name, report):
    said = [failure["what"] for failure in report["failures"] if failure["tool"] == name]
    return [what for what in said if "has no command in compile_commands.json" not in what]


def found_in(report):
    return {(one["path"], rule) for one in report["findings"] for rule in (one["rule"], *one.get("witnesses", ()))}
