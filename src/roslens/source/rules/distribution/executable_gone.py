"""Rule ``distribution.executable_gone``: a launch file starts a program that a distribution does not have."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache

import msgspec

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.distributions.read_changes import Change, Kind, changes_of
from roslens.source.rules.distribution.row_hit import row_message
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_view import LaunchXml


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each start of a program of the tables."""
    for file in view.launch:
        if not file.is_test:
            yield from _in_markup(file)
    for one in view.of_language(Language.LAUNCH_PYTHON, roles=(Role.OWN,)):
        yield from _in_python(view.read(one.path).decode("utf-8", "replace"), one.path)


def _in_markup(file: LaunchXml) -> Iterator[Hit]:
    for element, _ in file.elements:
        package = element.attributes.get("pkg", "")
        program = element.attributes.get("type") or element.attributes.get("exec", "")
        changes = [*changes_of(Kind.EXECUTABLE).get(f"{package}/{program}", ())]
        changes += (
            change for value in element.attributes.values() for change, written in _written() if written.search(value)
        )
        for change in changes:
            hit = file.hit("distribution.executable_gone", element, row_message(change, change.name), change.name)
            yield msgspec.structs.replace(hit, change=change.key)


def _in_python(text: str, path: str) -> Iterator[Hit]:
    for change, started in _started():
        for match in started.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            message = row_message(change, change.name)
            rule = "distribution.executable_gone"
            yield Hit(rule, message, line, context=change.name, path=path, change=change.key)


@cache
def _written() -> list[tuple[Change, re.Pattern[str]]]:
    """Return how each program is written in a command line."""
    return [
        (
            change,
            re.compile(rf"(?:\$\(find(?:-pkg-\w+)? {package}\)/(?:\w+/)*|\b{package} ){re.escape(name)}(?![\w./])"),
        )
        for change, package, name in _rows()
    ]


@cache
def _started() -> list[tuple[Change, re.Pattern[str]]]:
    """Return how Python starts each program."""
    keyword = r"\s*=\s*['\"]"
    return [
        (
            change,
            re.compile(
                rf"^(?!\s*#).*\b(?:node_)?executable{keyword}{re.escape(name)}['\"](?=[^()]*package{keyword}{package}['\"])"
                rf"|^(?!\s*#).*\bpackage{keyword}{package}['\"][^()]*?(?:node_)?executable{keyword}{re.escape(name)}['\"]",
                re.MULTILINE,
            ),
        )
        for change, package, name in _rows()
    ]


def _rows() -> Iterator[tuple[Change, str, str]]:
    for name, changes in changes_of(Kind.EXECUTABLE).items():
        package, _, program = name.partition("/")
        yield from ((change, package, program) for change in changes)


RULE = PackageRule(
    id="distribution.executable_gone",
    title="Program that the distribution does not have",
    finds="A launch file that starts a program which a distribution of ROS does not have under this name any more, by "
    "a dated table: `xacro.py`, which Noetic has not. For which distributions a package is built, `distro` in "
    "roslens.toml or `--distro` says; otherwise files of continuous integration and containers do. What is deprecated "
    "there, or gone in a later distribution where none is known, is a note.",
    why="The launch ends with a program that is not found, in that distribution only.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("distribution", "launch"),
    bad='<param name="robot_description" command="$(find xacro)/xacro.py $(find arm)/urdf/arm.xacro"/>',
    good='<param name="robot_description" command="$(find xacro)/xacro $(find arm)/urdf/arm.xacro"/>',
    found=found,
)
