"""Rule ``launch.ros1_syntax``: a launch file of a package for ROS 2 is written as those of ROS 1."""

from __future__ import annotations

from collections.abc import Iterator
from posixpath import basename

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_markup import LaunchMarkup, markup_files


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first thing in each launch file of a package for ROS 2 that only roslaunch of ROS 1 has."""
    if view.ros != frozenset({2}) or _is_for_both(view):
        return
    for file in markup_files(view):
        # What has something of ROS 2 in it is no file that was left over.
        certainty = Certainty.HEURISTIC if file.is_of_ros1 and _is_left_over(file, view) else None
        for entity, what, instead in file.of_ros1[:1] if file.is_of_ros1 else file.of_ros1:
            hit = file.hit("launch.ros1_syntax", entity, _message(file, what, instead), what)
            yield msgspec.structs.replace(hit, certainty=certainty)


def _is_for_both(view: PackageView) -> bool:
    """Whether the package is built for ROS 1 as well, by a condition or by its other files."""
    manifest = view.read(view.package.manifest.path) if view.package.manifest.path else b""
    return b"ROS_VERSION" in manifest or b"catkin" in manifest or "catkin" in view.cmake.text


def _is_left_over(file: LaunchMarkup, view: PackageView) -> bool:
    """Whether the package has the same launch file for ROS 2, or keeps it in a folder of ROS 1."""
    folder, _, name = view.inside(file.path).rpartition("/")
    stem = name.partition(".")[0]
    others = {basename(one) for one in view.listing} - {name}
    names = {f"{stem}.launch.py", f"{stem}_launch.py", f"{stem}.launch.xml", f"{stem}.launch.yaml", f"{stem}.py"}
    return bool(names & others) or "ros1" in folder.lower()


def _message(file: LaunchMarkup, what: str, instead: str) -> str:
    others = len({(entity.evidence.line, one) for entity, one, _ in file.of_ros1}) - 1 if file.is_of_ros1 else 0
    more = f" (and {others} more of ROS 1 in this file)" if others else ""
    expected = f"expected {instead}" if instead else "ROS 2 has nothing like it"
    return f"{what} is of ROS 1, and the package is for ROS 2: launch refuses the file{more}; {expected}"


RULE = PackageRule(
    id="launch.ros1_syntax",
    title="Launch file of ROS 1 in a package for ROS 2",
    finds="Elements, attributes and substitutions that only roslaunch of ROS 1 has, in a launch file in XML of a "
    "package for ROS 2: `type=` and `ns=` of `<node>`, `<rosparam>`, `<param command=…>`, `<param>` and `<remap>` "
    "outside of a node, `<arg value=…>`, `$(arg …)`, `$(find …)`. Of a file that has nothing "
    "of ROS 2 the first is reported; a note where the package has the same launch file for ROS 2.",
    why="launch of ROS 2 refuses what it does not know: `ros2 launch` ends before anything starts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    bad='<launch>\n  <node pkg="base" type="drive" name="drive"/>\n</launch>',
    good='<launch>\n  <node pkg="base" exec="drive" name="drive"/>\n</launch>',
    found=found,
)
