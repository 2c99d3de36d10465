"""Rule ``launch.description_type``: a robot description that launch reads as YAML."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

import msgspec

from roslens.model.source import Language
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.symbolic.text import Hole, Text
from roslens.source.rules.hit import Hit
from roslens.source.rules.launch.runs.xacro_output import has_sign, output_has_sign
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

if TYPE_CHECKING:
    from roslens.source.extract.launch_python.deferred import Value
    from roslens.source.extract.launch_python.launch_action import Parameter
    from roslens.source.rules.views.launch_runs import LaunchRun

_MENTIONS = (b"ommand", b"description")
_XACRO = "xacro"
_DESCRIPTION = re.compile(r"\.(?:urdf|xacro|sdf|xml)$")
_UNKNOWN = "\0"
_FOUND = re.compile(r"path of (?:the|a) program *(?P<name>.*)", re.DOTALL)
"""Why the path of a program is not known; without a name it is that of xacro, which descriptions are made by."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each parameter that is the output of a command and has no type."""
    for run in view.launch_runs:
        for parameter in _untyped(run) if all(one in run.content for one in _MENTIONS) else ():
            name, at = _plain(parameter.name), parameter.evidence
            hit = Hit(
                "launch.description_type", _message(name, run.path), at.line, at.column, context=name, path=run.path
            )
            yield (
                hit
                if _may_be_yaml(parameter.value, view)
                else msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)
            )


def _untyped(run: LaunchRun) -> Iterator[Parameter]:
    for action in run.actions:
        for one in action.parameters:
            if not one.type and one.file is None and _program(one.value):
                yield one


def _message(name: str, path: str) -> str:
    expected = "`ParameterValue(…, value_type=str)`" if path.endswith(".py") else 'type="str"'
    what = f"parameter {name!r} is the output of a command" if name else "a parameter is the output of a command"
    return f"{what}, which launch reads as YAML: it fails where that has a `: `, a ` #` or a tab; expected {expected}"


def _may_be_yaml(value: Value, view: PackageView) -> bool:
    """Whether, by the descriptions of the package, the output of a command may have what YAML takes for more."""
    files = {one.path: view.read(one.path) for one in view.of_language(Language.XACRO, Language.URDF)}
    return output_has_sign(files) if _program(value) == _XACRO else any(map(has_sign, files.values()))


def _program(value: Value) -> str:
    """Return the program of a command that is the value or a part of it; empty for a command that has none.

    ``Command([path])`` runs the description itself, which fails whatever the type of the parameter is.
    """
    kind, parts = getattr(value, "kind", ""), getattr(value, "parts", ())
    if kind == "text":
        return next(filter(None, map(_program, parts)), "")
    words = _written(value).split() if kind == "command" else []
    names = [one.strip("'\"").rpartition("/")[2] for one in words]
    if _XACRO in names:
        return _XACRO
    return "" if not names or names[0].startswith(_UNKNOWN) or _DESCRIPTION.search(names[0]) else names[0]


def _written(value: Value | Hole) -> str:
    """Return a command with a sign for each piece that is not known."""
    match value:
        case str():
            return value
        case Text():
            return "".join(map(_written, value.parts))
        case Hole():
            return _found_program(str(value.reason))
        case Deferred(kind="unknown"):
            return _found_program(str(value.parts[0])) if value.parts else _UNKNOWN
        case Deferred(kind="path"):
            return "/".join(map(_written, value.parts))
        case Deferred(kind="command" | "text"):
            return "".join(map(_written, value.parts))
    return _UNKNOWN


def _found_program(reason: str) -> str:
    match = _FOUND.fullmatch(reason)
    return (match["name"] or _XACRO) if match else _UNKNOWN


def _plain(value: Value) -> str:
    return value if isinstance(value, str) else ""


RULE = PackageRule(
    id="launch.description_type",
    title="Robot description that launch reads as YAML",
    finds="A parameter in a launch file of ROS 2, in Python, XML or YAML, whose value is the output of a command such "
    "as `xacro` and that has no type. It is a note where no `: `, ` #` or tab in a description of the package "
    "reaches the output: xacro drops comments before its own elements. A command without a program fails before.",
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
