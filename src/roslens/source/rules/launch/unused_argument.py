"""Rule ``launch.unused_argument``: an argument that changes nothing."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_view import ROS_1_ARGUMENT, ROS_2_ARGUMENT, LaunchXml

_OTHERS = ("pass_all_args", "$(eval", "$(command", "<include", "<let", "<set_")
_LONGEST = 200_000
"""Characters; a longer file is made by a program."""
_DECLARED = re.compile(r"DeclareLaunchArgument\(\s*(?:name\s*=\s*)?(['\"])([\w./-]+)\1")
_SWITCHED = re.compile(r"""default_value\s*=\s*(?:\[\s*)?["'](?:true|false)["']""", re.IGNORECASE)
"""The default of an argument that turns something on or off."""
_TRUTHS = frozenset({"true", "false", "True", "False"})
_INDIRECT = re.compile(r"IncludeLaunchDescription|OpaqueFunction|launch_configurations|AnyLaunchDescription|perform\(")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each argument that is declared and never used in its file."""
    for file in view.launch:
        if not file.broken and not file.is_test and "/includes/" not in file.path:
            yield from _of_xml(file, view)
    for one in view.of_language(Language.LAUNCH_PYTHON, roles=(Role.OWN,)):
        text = view.read(one.path).decode("utf-8", "replace")
        if len(text) <= _LONGEST and not _INDIRECT.search(text) and not _is_listed(text):
            yield from _of_python(text, one.path, view)


def _of_python(text: str, path: str, view: PackageView) -> Iterator[Hit]:
    for match in _DECLARED.finditer(text):
        name = match[2]
        if len(re.findall(rf"['\"]{re.escape(name)}['\"]", text)) != 1:
            continue
        line = text.count("\n", 0, match.start()) + 1
        switches = _SWITCHED.search(text, match.end(), text.find(")", match.end())) is not None
        certainty = None if switches and _is_alone(name, path, view) else Certainty.HEURISTIC
        yield Hit("launch.unused_argument", _message(name), line, context=name, path=path, certainty=certainty)


def _of_xml(file: LaunchXml, view: PackageView) -> Iterator[Hit]:
    is_ros_1 = ROS_1_ARGUMENT.search(file.text) is not None or " type=" in file.text
    used = {*ROS_1_ARGUMENT.findall(file.written), *ROS_2_ARGUMENT.findall(file.written)}
    if any(word in file.text for word in (_OTHERS[:1] if is_ros_1 else _OTHERS)):
        # What is included inherits the arguments of ROS 2.
        return
    evaluated = " ".join(re.findall(r"\$\(eval[^\n]*", file.text))
    for element, around in file.elements:
        name = element.attributes.get("name", "")
        if element.tag != "arg" or around == "include" or not name or name in used:
            continue
        if name not in evaluated or not re.search(rf"\b{re.escape(name)}\b", evaluated):
            switches = view.ros == {2} and not is_ros_1 and element.attributes.get("default") in _TRUTHS
            hit = file.hit("launch.unused_argument", element, _message(name), name)
            is_certain = switches and _is_alone(name, file.path, view)
            yield hit if is_certain else msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)


def _is_alone(name: str, path: str, view: PackageView) -> bool:
    """Return whether no other launch file of the package has the name: siblings may take the same arguments."""
    word = re.compile(rb"\b" + re.escape(name.encode()) + rb"\b")
    files = view.of_language(Language.LAUNCH_PYTHON, Language.LAUNCH_XML, Language.LAUNCH_YAML)
    return not any(word.search(view.read(one.path)) for one in files if one.path != path)


def _is_listed(text: str) -> bool:
    """Return whether names of configurations are computed: a loop over names finds all of them."""
    return re.search(r"LaunchConfiguration\(\s*\w+\s*\)", text) is not None


def _message(name: str) -> str:
    return f"argument {name!r} is declared and nothing in the file uses it; expected its use, or no argument"


RULE = PackageRule(
    id="launch.unused_argument",
    title="Launch argument that changes nothing",
    finds="An `<arg>`, or a `DeclareLaunchArgument`, whose value nothing in the file uses. Files of ROS 2 that "
    "include others are left out: these inherit the arguments; so are those in a folder `includes`, which take "
    "what their siblings take. It is a warning of an argument of ROS 2 that is true or false by default, "
    "which is there to turn something on or off, and that no other launch file of the package has too.",
    why="Whoever starts the robot sets it, sees no error, and the robot does what it did before.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("launch",),
    bad='<launch>\n  <arg name="max_speed" default="0.5"/>\n  <node pkg="base" type="drive" name="drive"/>\n</launch>',
    good='<launch>\n  <arg name="max_speed" default="0.5"/>\n  <node pkg="base" type="drive" name="drive">\n    '
    '<param name="max_speed" value="$(arg max_speed)"/>\n  </node>\n</launch>',
    found=found,
)
