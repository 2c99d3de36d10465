"""Rule ``distribution.package_gone``: a dependency that a distribution of ROS does not have any more."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.distributions.read_changes import Kind, changes_of
from roslens.source.rules.distribution.row_hit import row_message
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_ASKING = frozenset({"build", "build_export", "buildtool", "exec", "run", "depend", "test"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first tag of each dependency of the tables."""
    seen: set[str] = set()
    for one in view.package.dependencies:
        if one.kind not in _ASKING or not one.active or one.condition or one.name in seen:
            continue
        seen.add(one.name)
        for change in changes_of(Kind.PACKAGE).get(one.name, ()):
            where = one.location
            message = f"dependency {row_message(change, one.name)}"
            yield Hit(
                "distribution.package_gone",
                message,
                where.line,
                where.column,
                context=one.name,
                path=where.path,
                change=change.key,
            )


RULE = PackageRule(
    id="distribution.package_gone",
    title="Dependency that the distribution does not have",
    finds="A dependency in package.xml that a distribution of ROS renamed or does not have any more, by a dated table: "
    "`gazebo_ros` from Jazzy on. One with a condition, or that the workspace has itself, is left out. For which "
    "distributions a package is built, `distro` in roslens.toml or `--distro` says; otherwise files of continuous "
    "integration and containers do. What is deprecated there, or gone in a later distribution where none is known, is "
    "a note.",
    why="rosdep finds no package to install, or CMake none to build with, in that distribution only.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("distribution", "manifest"),
    bad="<exec_depend>ros_ign_bridge</exec_depend>  <!-- for Jazzy -->",
    good="<exec_depend>ros_gz_bridge</exec_depend>",
    found=found,
)
