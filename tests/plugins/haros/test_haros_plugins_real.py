"""The plug-ins that ship with HAROS (haros-plugins 1.1.5), unmodified, on today's Python.

docs/reference/haros_plugins.md states which of the eight run and why the others do not: this is the test
of that page.
"""

import json
import os
import shutil
import subprocess
import sysconfig
from pathlib import Path

import pytest
from fresh_environment import fresh_environment, pip_install

pytestmark = pytest.mark.real

EXAMPLES = Path(__file__).parents[3] / "examples" / "workspace" / "src"

RUN = """
import json, sys
from pathlib import Path
import msgspec
from roslens.plugins.discovery import discover
from roslens.plugins.isolation import run_plugins
from roslens.plugins.sample import sample_workspace
found = discover([], base=Path("."))
outcome = run_plugins(found.members, sample_workspace(Path(sys.argv[1])), jobs=2, log=Path("log"))
result = {"members": [member.name for member in found.members], "unloaded": [str(f) for f in found.failures]}
print(json.dumps(result | msgspec.to_builtins(outcome)))
"""


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """Return an environment with haros-plugins and with everything that this one has."""
    folder = tmp_path_factory.mktemp("haros")
    environment = folder / "venv"
    done = pip_install(fresh_environment(environment), "haros-plugins==1.1.5", "future")
    if done.returncode:
        pytest.skip(f"haros-plugins cannot be had: {done.stderr.strip().splitlines()[-1]}")
    packages = next((environment / "lib").glob("python*/site-packages"))
    (packages / "shared.pth").write_text(f"import site; site.addsitedir({sysconfig.get_paths()['purelib']!r})\n")
    return environment


def run(environment, workspace):
    path = f"{environment / 'bin'}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        [str(environment / "bin" / "python"), "-c", RUN, str(workspace)],
        capture_output=True,
        text=True,
        check=False,
        cwd=environment.parent,
        env={**os.environ, "PATH": path},
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def ran(environment, fixtures):
    return run(environment, fixtures / "haros_workspace")


def rules(ran, plugin):
    prefix = f"haros_plugin_{plugin}."
    return [f["rule"].removeprefix(prefix) for f in ran["findings"] if f["rule"].startswith(prefix)]


def values(ran, plugin):
    prefix = f"haros_plugin_{plugin}."
    return {
        (m["entity"], m["quantity"].removeprefix(prefix)): m["value"]
        for m in ran["measurements"]
        if m["quantity"].startswith(prefix)
    }


def failures(ran, plugin):
    return [f["what"] for f in ran["failures"] if f["tool"] == f"haros_plugin_{plugin}"]


def test_all_eight_load(ran):
    names = ["cccc", "ccd", "cppcheck", "cpplint", "lizard", "mi_calculator", "pylint", "radon"]
    assert ran["members"] == [f"haros_plugin_{name}" for name in names]
    assert ran["unloaded"] == []


def test_lizard(ran):
    assert sorted(rules(ran, "lizard")) == [
        "max_cyclomatic_complexity_10",
        "max_cyclomatic_complexity_15",
        "max_function_length_40",
        "max_function_parameters_6",
    ]
    assert values(ran, "lizard")["file:robot/src/robot.cpp", "ploc"] > 40


def test_cpplint(ran):
    assert "opening_curly_brace" in rules(ran, "cpplint")
    assert not failures(ran, "cpplint")


def test_pylint(ran):
    assert set(rules(ran, "pylint")) >= {"convention", "warning"}
    assert not failures(ran, "pylint")


def test_radon_breaks_by_itself_and_what_it_reported_before_stays(ran):
    assert values(ran, "radon")["file:robot/scripts/robot.py", "sloc"] == 5
    assert any("NameError: name 'ploc' is not defined" in what for what in failures(ran, "radon"))


def test_ccd(ran):
    found = values(ran, "ccd")
    path = "file:robot/src/robot.cpp"
    assert found[path, "comments"] == 1
    assert found[path, "halstead_volume"] > 100
    assert not failures(ran, "ccd")


def test_mi_calculator_works_on_what_ccd_and_lizard_report(ran):
    """HAROS takes the length of the last function for that of the file; so it does here."""
    (entity,) = {entity for entity, _ in values(ran, "mi_calculator")}
    assert entity == "file:robot/src/robot.cpp"
    assert 0 < values(ran, "mi_calculator")[entity, "maintainability_index"] < 100
    assert not failures(ran, "mi_calculator")


@pytest.mark.parametrize("name", ["cccc", "cppcheck"])
def test_those_that_need_a_program_say_so(ran, name):
    if shutil.which(name):
        assert not [what for what in failures(ran, name) if "name functions or classes" not in what]
    else:
        assert any(f"No such file or directory: '{name}'" in what for what in failures(ran, name))


def test_the_example_workspace(environment, tmp_path):
    """Findings and values of every plug-in that works, and no failure but the known ones.

    Three packages of it: of both languages, with the longest functions, and with the file that is not UTF-8. To start
    pylint for each file of all of them takes a minute.
    """
    for package in ("rover/rover_navigation", "rover_legacy/rover_docking", "rover_legacy/rover_teleop"):
        shutil.copytree(EXAMPLES / package, tmp_path / package)
    result = run(environment, tmp_path)
    for name in ("cpplint", "lizard", "pylint", "ccd", "mi_calculator"):
        assert rules(result, name), name
    for name in ("lizard", "ccd", "mi_calculator", "radon"):
        assert values(result, name), name
    own_faults = ("name functions or classes", "joystick_profile.cpp: UnicodeDecodeError")
    for name in ("cpplint", "lizard", "pylint", "ccd", "mi_calculator"):
        assert not [what for what in failures(result, name) if not any(one in what for one in own_faults)], name
    assert any("joystick_profile.cpp" in what for what in failures(result, "ccd")), "ccd reads UTF-8 only"
    assert any("NameError: name 'ploc' is not defined" in what for what in failures(result, "radon"))
