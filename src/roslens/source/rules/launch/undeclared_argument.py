"""Rule ``launch.undeclared_argument``: an argument is used that the file does not declare."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_view import ROS_1_ARGUMENT, LaunchXml
from roslens.source.rules.views.passed_arguments import Passing, declared_in
from roslens.source.workspace.elements import Element


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first use of each argument that a launch file of ROS 1 uses and does not declare."""
    passing = Passing(view)
    for file in view.launch:
        declared = {*declared_in(file)}
        if file.broken or file.is_test:
            continue
        known = frozenset(declared)
        for element, visible in _in_scope(file):
            for name in _used(element):
                if name not in declared or (name in known and not any(name in one for one in visible)):
                    # Each name once.
                    declared.add(name)
                    known -= {name}
                    yield from _hits(file, element, name, passing)


def _in_scope(file: LaunchXml) -> Iterator[tuple[Element, tuple[set[str], ...]]]:
    """Yield each element with the names that are declared before it, by the file and by each ``<group>`` around it."""
    root = file.root
    waiting: list[tuple[Element, tuple[set[str], ...], str]] = [(root, (set(),), "")] if root is not None else []
    while waiting:
        element, visible, around = waiting.pop()
        yield element, visible
        if element.tag == "arg" and around != "include":
            visible[-1].add(element.attributes.get("name", ""))
        inside = (*visible, set()) if element.tag == "group" else visible
        waiting.extend((child, inside, element.tag) for child in reversed(element.elements()))


def _hits(file: LaunchXml, element: Element, name: str, passing: Passing) -> Iterator[Hit]:
    if passing.is_passed(file, name):
        return
    if name in declared_in(file):
        what = (
            f"$(arg {name}) is used where <arg name={name!r}> is not known: it comes later, or in a <group> that ended"
        )
        message = f"{what}; expected it before this element, outside of the <group>"
    else:
        what = f"$(arg {name}) is used, and the file has no <arg name={name!r}>"
        message = f"{what}; expected it, unless it is passed by pass_all_args or on the command line"
    hit = file.hit("launch.undeclared_argument", element, message, name)
    is_meant = not passing.is_included(file) and not _has_default(file, name)
    is_meant = is_meant or passing.is_on_a_command_line(file, name)
    yield msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) if is_meant else hit


def _has_default(file: LaunchXml, name: str) -> bool:
    """Return whether a file gives an argument a value somewhere, so that nobody is meant to give it from outside."""
    return any(
        element.tag == "arg" and around != "include" and element.attributes.get("name") == name
        and {"default", "value"} & set(element.attributes)
        for element, around in file.elements
    )  # fmt: skip


def _used(element: Element) -> Iterator[str]:
    """Yield the names of arguments that stand in the attributes and the text of an element."""
    # Of texts roslaunch looks at those of <rosparam> alone.
    text = element.text() if element.tag == "rosparam" else ""
    for value in (*element.attributes.values(), text):
        yield from ROS_1_ARGUMENT.findall(value)


RULE = PackageRule(
    id="launch.undeclared_argument",
    title="Launch argument that is not declared",
    finds='`$(arg name)` in a launch file of ROS 1 that has no `<arg name="name"/>`. Declare it, with a default '
    "where there is one. The files of ROS 2 are left out: they inherit what the including file declares. So is "
    "what all files that include this one pass on by `pass_all_args`; where no launch file includes it, so that "
    "whoever starts it may give the argument, or a script or README does so with `name:=`, it is a note. An argument "
    "that the file declares with a default too late, or in a `<group>` that ended, nobody is meant to give.",
    why='roslaunch ends with "arg has not been set"; in a branch behind `if` it does so on the day somebody takes it.',
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("launch",),
    bad='<launch>\n  <node pkg="joy" type="joy_node" name="joy"><param name="dev" value="$(arg '
    'device)"/></node>\n</launch>',
    good='<launch>\n  <arg name="device" default="/dev/input/js0"/>\n  <node pkg="joy" type="joy_node" '
    'name="joy"><param name="dev" value="$(arg device)"/></node>\n</launch>',
    found=found,
)
