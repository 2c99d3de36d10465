"""Rule ``launch.include_argument``: an included launch file is given an argument that it does not know."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches
from posixpath import join
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_view import LaunchXml
from roslens.source.rules.views.passed_arguments import declared_in

if TYPE_CHECKING:
    from roslens.source.extract.launch_python.launch_action import Action
    from roslens.source.rules.views.launch_runs import LaunchRun
    from roslens.source.workspace.elements import Element

_FIND = re.compile(r"\$\(find\s+([\w-]+)\s*\)/+")
_COMPUTED = re.compile(rb"LaunchConfiguration\(\s*(?!['\"])|launch_configurations\s*(?!\[\s*['\"]|\.get\(\s*['\"])")
"""Names of configurations that are computed: any may be meant."""
_INCLUDES = re.compile(rb"IncludeLaunchDescription\(")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each argument that is given to a launch file of the package and that has no use there."""
    if view.ros == frozenset({1}):
        yield from _of_ros1(view)
        return
    runs = {run.path: run for run in view.launch_runs}
    for run in runs.values():
        for action in run.actions:
            target = runs.get(run.included(action) or "") if action.kind == "include" else None
            if target is not None and target is not run:
                yield from _unused(run, action, target, runs)


def _unused(run: LaunchRun, include: Action, target: LaunchRun, runs: dict[str, LaunchRun]) -> Iterator[Hit]:
    reached, is_whole = _reached(target, runs)
    declared = [name for one in reached for name in one.declared]
    for child in include.children:
        name = child.values.get("name")
        if not isinstance(name, str) or any(_mentions(one, name) for one in reached):
            continue
        close = get_close_matches(name, declared, 1, 0.8)
        if not is_whole and not close:
            continue
        others = f"one of {', '.join(sorted({*declared}))}" if declared else "no argument"
        expected = f"{close[0]!r}" if close else others
        what = f"argument {name!r} is given to {target.path.rpartition('/')[2]}, which neither declares nor uses it"
        at = child.evidence
        yield Hit(
            "launch.include_argument",
            f"{what}: it changes nothing; expected {expected}",
            at.line,
            at.column,
            context=name,
            path=run.path,
            certainty=Certainty.LIKELY,
            consequence=Consequence.MAY_BE_WRONG,
        )


def _reached(target: LaunchRun, runs: dict[str, LaunchRun]) -> tuple[list[LaunchRun], bool]:
    """Return a file with those that it includes, and whether these are all that the arguments go to."""
    found, is_whole = [target], True
    for one in found:
        is_open = any(action.kind == "unknown" for action in one.actions) or not one.actions
        is_whole = is_whole and not is_open and not _COMPUTED.search(one.content)
        includes = [action for action in one.actions if action.kind == "include"]
        is_whole = is_whole and len(includes) >= len(_INCLUDES.findall(one.content))
        for action in includes:
            further = runs.get(one.included(action) or "")
            is_whole = is_whole and further is not None
            if further is not None and further not in found:
                found.append(further)
    return found, is_whole


def _mentions(run: LaunchRun, name: str) -> bool:
    return re.search(rb"(?<![\w-])%s(?![\w-])" % re.escape(name.encode()), run.content) is not None


def _of_ros1(view: PackageView) -> Iterator[Hit]:
    files = {file.path: file for file in view.launch if not file.broken}
    for file in files.values():
        for element, _ in () if file.is_test else file.elements:
            path = "" if element.start in file.left_out else _included(element, view)
            target = files.get(path) or _beside(path, view)
            if target is not None:
                yield from _undeclared(file, element, target)


def _undeclared(file: LaunchXml, include: Element, target: LaunchXml) -> Iterator[Hit]:
    declared = list(declared_in(target))
    for one in include.elements():
        name = one.attributes.get("name", "")
        if one.tag == "arg" and name and name not in declared:
            yield file.hit("launch.include_argument", one, _message(name, target, declared), name)


def _included(include: Element, view: PackageView) -> str:
    """Return the path of the file of the workspace that an element includes without passing on all that it has."""
    if include.tag != "include" or include.attributes.get("pass_all_args", "").strip().lower() in ("true", "1"):
        return ""
    written = include.attributes.get("file", "")
    match = _FIND.match(written)
    if match is None or "$" in written[match.end() :]:
        return ""
    folders = {**dict(view.around.folders), view.package.name: view.folder}
    return join(folders[match[1]], written[match.end() :]) if match[1] in folders else ""


def _beside(path: str, view: PackageView) -> LaunchXml | None:
    """Return a launch file of another package of the workspace; nothing where it is not there or is broken."""
    if not path or not view.exists(path):
        return None
    file = LaunchXml(view, path, is_test=False)
    return None if file.broken or file.root is None or file.root.tag != "launch" else file


def _message(name: str, target: LaunchXml, declared: list[str]) -> str:
    close = get_close_matches(name, declared, 1)
    expected = f"{close[0]!r}" if close else f"one of {', '.join(declared)}" if declared else "no argument"
    what = f"argument {name!r} is given to {target.path.rpartition('/')[2]}, which does not declare it"
    return f'{what}: roslaunch ends with "unused args"; expected {expected}'


RULE = PackageRule(
    id="launch.include_argument",
    title="Argument that an included launch file does not know",
    finds="An argument that a launch file gives to another one of its package, in ROS 1 also of another package of "
    "the workspace, that does not declare it. In ROS 1 roslaunch refuses it. In ROS 2 it is a warning, and reported "
    "where neither the included file nor one that it includes in turn mentions the name, and all of these are in the "
    "package.",
    why="roslaunch ends before anything starts; launch of ROS 2 sets a configuration that nobody reads, and the robot "
    "does what the default says.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("launch",),
    bad='<include file="$(find base)/launch/drive.launch">\n  <arg name="sped" value="1.0"/>\n</include>',
    good='<include file="$(find base)/launch/drive.launch">\n  <arg name="speed" value="1.0"/>\n</include>',
    found=found,
)
