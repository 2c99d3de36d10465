"""Idioms of launch files in Python: what they come to is what Python makes of them, and what launch says they mean."""

import os
import sys
from pathlib import Path
from types import ModuleType

import pytest

from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.launch.launch_ros2 import evaluate_ros2

HERE = Path(__file__).parents[3] / "fixtures/extract/launch_idioms"
LAUNCH = "src/car/launch/x.launch.py"
HEAD = (HERE / "head.txt").read_text()
CAR = "src/car/config/car.yaml"


def lines(name):
    """Return expressions with the text that each comes to: the file of parameters, where nothing else is said."""
    found = [one.partition("  ## ") for one in (HERE / name).read_text().splitlines()]
    return [(expression, other.encode().decode("unicode_escape") or CAR) for expression, _, other in found]


def bodies():
    """Return bodies of launch files with the names of the nodes that they start."""
    parts = [one.partition("\n") for one in (HERE / "nodes.txt").read_text().split("\n---\n")]
    return [(body, first.removeprefix("#").split()) for first, _, body in parts]


class Workspace(FolderFiles):
    def __init__(self, program):
        super().__init__(HERE, {"car": "src/car"})
        self.program = program

    def content(self, path):
        return self.program.encode() if path == LAUNCH else super().content(path)


def evaluated(program):
    return evaluate_ros2(LAUNCH, Workspace(program))


def value_of(expression):
    given = (
        "DeclareLaunchArgument('file', default_value='car.yaml'), DeclareLaunchArgument('fd', default_value='config')"
    )
    node = f"Node(package='car', executable='e', name='n', parameters=[{{'p': {expression}}}])"
    program = f"{HEAD}def generate_launch_description():\n    return LaunchDescription([{given}, {node}])\n"
    (node,) = evaluated(program).nodes
    (setting,) = node.settings
    return setting.value


@pytest.fixture
def real(monkeypatch):
    """The names that the head of a launch file has in Python, with packages found in the workspace."""
    monkeypatch.chdir(HERE)
    monkeypatch.syspath_prepend(str(HERE / "src/car"))
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    stubs = {}
    for name in ("ament_index_python", "ament_index_python.packages", "launch", "launch.actions",
                 "launch.substitutions", "launch_ros", "launch_ros.actions", "launch_ros.substitutions"):  # fmt: skip
        stubs[name] = ModuleType(name)
        stubs[name].__getattr__ = lambda _name: lambda *_given, **_named: None
    folders = stubs["ament_index_python.packages"]
    folders.get_package_share_directory = lambda name: f"src/{name}"
    folders.get_package_share_path = lambda name: Path(f"src/{name}")
    for name, stub in stubs.items():
        monkeypatch.setitem(sys.modules, name, stub)
    names = {"__file__": LAUNCH}
    exec(compile(HEAD, LAUNCH, "exec"), names)
    yield names
    for name in [one for one in sys.modules if one == "car" or one.startswith("car.")]:
        del sys.modules[name]


@pytest.mark.parametrize(("expression", "expected"), lines("paths.txt"))
def test_a_path_comes_to_what_python_makes_of_it(real, expression, expected):
    found = eval(expression, real)
    assert os.path.relpath(found, HERE) == expected
    assert value_of(expression).known == expected


@pytest.mark.parametrize(("expression", "expected"), lines("substitutions.txt"))
def test_a_substitution_comes_to_what_launch_makes_of_it(expression, expected):
    assert value_of(expression).known == expected


@pytest.mark.parametrize(("body", "expected"), bodies())
def test_nodes_are_those_that_are_started(body, expected):
    found = evaluated(HEAD + body + "\n")
    assert ([one.name.known for one in found.nodes], found.unresolved) == (expected, ())
