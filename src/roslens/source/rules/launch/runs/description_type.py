"""Rule ``launch.description_type``: a robot description that launch reads as YAML."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import msgspec

from roslens.model.source import Language
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

if TYPE_CHECKING:
    from roslens.source.extract.launch_python.deferred import Value
    from roslens.source.extract.launch_python.launch_action import Parameter
    from roslens.source.rules.views.launch_runs import LaunchRun

_MENTIONS = (b"ommand", b"description")
_SIGNS = (b": ", b" #")
"""What makes YAML of a text something else than a text."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each parameter that is the output of a command and has no type."""
    for run in view.launch_runs:
        for parameter in _untyped(run) if all(one in run.content for one in _MENTIONS) else ():
            name, at = _plain(parameter.name), parameter.evidence
            hit = Hit(
                "launch.description_type", _message(name, run.path), at.line, at.column, context=name, path=run.path
            )
            yield hit if _may_be_yaml(view) else msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)


def _untyped(run: LaunchRun) -> Iterator[Parameter]:
    for action in run.actions:
        for one in action.parameters:
            if not one.type and one.file is None and _is_of_command(one.value):
                yield one


def _message(name: str, path: str) -> str:
    expected = "`ParameterValue(…, value_type=str)`" if path.endswith(".py") else 'type="str"'
    what = f"parameter {name!r} is the output of a command" if name else "a parameter is the output of a command"
    return f"{what}, which launch reads as YAML: it fails at a `: ` in a comment of it; expected {expected}"


def _may_be_yaml(view: PackageView) -> bool:
    """Whether a description of the package has what YAML takes for something else."""
    files = view.of_language(Language.XACRO, Language.URDF)
    return any(sign in view.read(one.path) for one in files for sign in _SIGNS)


def _is_of_command(value: Value) -> bool:
    kind, parts = getattr(value, "kind", ""), getattr(value, "parts", ())
    return kind == "command" or (kind == "text" and any(map(_is_of_command, parts)))


def _plain(value: Value) -> str:
    return value if isinstance(value, str) else ""


RULE = PackageRule(
    id="launch.description_type",
    title="Robot description that launch reads as YAML",
    finds="A parameter in a launch file of ROS 2, in Python, XML or YAML, whose value is the output of a command such "
    "as `xacro` and that has no type. It is a note where no description of the package has `: ` or ` #` in it.",
    why="launch reads what has no type as YAML: a comment with a colon in any included description ends the launch "
    'with "Unable to parse the value of parameter robot_description as yaml".',
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("launch",),
    bad='<node pkg="robot_state_publisher" exec="robot_state_publisher">\n'
    '  <param name="robot_description" value="$(command \'xacro arm.urdf.xacro\')"/>\n</node>',
    good='<node pkg="robot_state_publisher" exec="robot_state_publisher">\n'
    '  <param name="robot_description" value="$(command \'xacro arm.urdf.xacro\')" type="str"/>\n</node>',
    found=found,
)
