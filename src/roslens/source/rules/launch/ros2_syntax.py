"""Rule ``launch.ros2_syntax``: a launch file of a package for ROS 1 is written as those of ROS 2."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_markup import markup_files


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first thing in each launch file of a package for ROS 1 that only launch of ROS 2 has."""
    if view.ros != frozenset({1}):
        return
    for file in markup_files(view):
        # A file that is wholly of ROS 2 lies beside one of ROS 1 in a package that is being ported.
        if not file.of_ros2 or not file.of_ros1 or file.path.endswith((".launch.xml", ".yaml", ".yml")):
            continue
        entity, what, instead = file.of_ros2[0]
        expected = f"expected {instead}" if instead else "ROS 1 has nothing like it"
        message = f"{what} is of ROS 2, and the file is for ROS 1: roslaunch does not know it; {expected}"
        yield file.hit("launch.ros2_syntax", entity, message, what)


RULE = PackageRule(
    id="launch.ros2_syntax",
    title="Syntax of ROS 2 in a launch file of ROS 1",
    finds="Elements, attributes and substitutions that only launch of ROS 2 has, such as `exec=`, `$(var …)` and "
    "`$(find-pkg-share …)`, in a launch file of a package for ROS 1 that is otherwise written for roslaunch. The "
    "first of a file is reported.",
    why="roslaunch ends at a substitution that it does not know, and ignores other elements and attributes with a "
    "warning.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros1",),
    tags=("launch",),
    bad='<launch>\n  <node pkg="joy" type="joy_node" name="$(var name)"/>\n</launch>',
    good='<launch>\n  <node pkg="joy" type="joy_node" name="$(arg name)"/>\n</launch>',
    found=found,
)
