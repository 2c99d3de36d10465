"""Rule ``launch.spawned_type``: a controller that is spawned and that no parameter file gives a type."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.model.source import Language
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_places import keyword_place

if TYPE_CHECKING:
    from roslens.source.extract.facts.launched import Launched
    from roslens.source.extract.facts.node_facts import Evidence
    from roslens.source.rules.views.launch_runs import LaunchRun

_ID = "launch.spawned_type"
_PACKAGE = "controller_manager"
_MANAGERS, _SPAWNERS = frozenset({"ros2_control_node"}), frozenset({"spawner", "spawner.py"})
_GIVES_TYPE = frozenset({"-t", "--controller-type", "-p", "--param-file"})
"""Options by which a spawner says the type itself, or reads a file with it."""
_WITH_VALUE = frozenset({
    "-c", "--controller-manager", "-n", "--namespace", "--controller-manager-timeout", "--switch-timeout",
    "--service-call-timeout", "--controller-ros-args", "--timeout", "--strictness",
})  # fmt: skip
_TYPE = re.compile(r"(?:^|\.)([^.]+)\.type$")
_TEXTS = (Language.YAML, Language.XACRO, Language.URDF, Language.LAUNCH_PYTHON, Language.LAUNCH_XML, Language.CPP)


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each controller without a type that a launch file spawns, which gives types to others."""
    runs = [run for run in view.launch_runs if _PACKAGE.encode() in run.content]
    places = dict.fromkeys(place for run in runs for place in _untyped(run))
    for at, name in places:
        if at.path in view.by_path and not _is_typed_elsewhere(name, view):
            line, column = keyword_place(view, at, "arguments")
            yield Hit(_ID, _message(name), line, column, context=name, path=at.path)


def _untyped(run: LaunchRun) -> Iterator[tuple[Evidence, str]]:
    """Yield the controllers that a launch file spawns, and whose type the manager that it starts is not given.

    None where the manager runs in a simulator, or something of the launch is not known: a file of another package.
    """
    nodes = run.launch.nodes
    managers = [node for node in nodes if _is_of(node, _MANAGERS)]
    if len(managers) != 1 or run.launch.unresolved:
        return
    typed = _typed(managers[0])
    for node in nodes if typed else ():
        if _is_of(node, _SPAWNERS):
            yield from ((node.evidence, name) for name in _names(node) if name not in typed)


def _typed(manager: Launched) -> frozenset[str]:
    """Return the controllers to which the parameters of a manager give a type, each below whichever node."""
    names = (_TYPE.search(str(one.name)) for one in manager.settings)
    own = {one.node.rpartition("/")[2] for one in manager.settings if str(one.name) == "type"}
    return frozenset({match[1] for match in names if match is not None} | own)


def _is_of(node: Launched, executables: frozenset[str]) -> bool:
    return node.package.known == _PACKAGE and (node.executable.known or "") in executables


def _names(node: Launched) -> tuple[str, ...]:
    """Return the names that a spawner is given; none where a word is not known, or says the type."""
    words = [one.known for one in node.arguments]
    if None in words or _GIVES_TYPE & {(word or "").partition("=")[0] for word in words}:
        return ()
    given = iter(word or "" for word in (words[: words.index("--ros-args")] if "--ros-args" in words else words))
    found = []
    for word in given:
        if word in _WITH_VALUE:
            next(given, "")
        elif not word.startswith("-"):
            found.append(word)
    return tuple(found)


def _is_typed_elsewhere(name: str, view: PackageView) -> bool:
    """Return whether a file of the package names a controller together with a type in some other way."""
    word = re.compile(rb"\b" + re.escape(name.encode()) + rb"\b[\w\"'/]*[.:]\s*type\b|\b" + re.escape(name.encode())
                      + rb"\b[^\n]*\n\s*[\"']?type\b")  # fmt: skip
    return any(word.search(view.read(file.path)) for file in view.of_language(*_TEXTS))


def _message(name: str) -> str:
    return (
        f"controller {name!r} is spawned, and no parameter of its manager says its type: it cannot be loaded; "
        f"expected `{name}: {{type: …}}` below the parameters of the controller manager"
    )


RULE = PackageRule(
    id=_ID,
    title="Spawned controller without a type",
    finds="A controller that a launch file of ROS 2 spawns by `controller_manager spawner`, and to which the "
    "parameters of the `ros2_control_node` that it starts give no type, although they give one to other controllers. "
    "Spawners with `--controller-type` or `--param-file` are left out, and launch files of which something is not "
    "known.",
    why="«The 'type' param was not defined for …»: the spawner ends, and what the controller moves stands still.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("launch", "configuration"),
    bad="controller_manager:\n  ros__parameters:\n    state_broadcaster: {type: "
    "joint_state_broadcaster/JointStateBroadcaster}\n# Node(package='controller_manager', executable='spawner', "
    "arguments=['state_broadcaster', 'arm_controller'])",
    good="controller_manager:\n  ros__parameters:\n    state_broadcaster: {type: "
    "joint_state_broadcaster/JointStateBroadcaster}\n    arm_controller: {type: "
    "joint_trajectory_controller/JointTrajectoryController}\n# Node(package='controller_manager', "
    "executable='spawner', arguments=['state_broadcaster', 'arm_controller'])",
    found=found,
)
