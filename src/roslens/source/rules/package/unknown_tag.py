"""Rule ``package.unknown_tag``: a manifest has a tag that its format does not know."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.mistaken import mistaken
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each tag and attribute that the format of the manifest does not have."""
    from roslens.source.workspace.validity import TAG

    yield from mistaken(view, "package.unknown_tag", TAG)


RULE = PackageRule(
    id="package.unknown_tag",
    title="Tag that the format of the manifest does not have",
    finds="A tag or an attribute that the `format` of package.xml does not have: `<run_depend>` in format 2 and 3, "
    "`<exec_depend>` in format 1, conditions before format 3, what was misspelt, and tags inside of others.",
    why="catkin_pkg, which catkin, colcon, bloom and rosdep read manifests with, refuses the file: the package is "
    "left out of the build, or the dependency is not installed.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad='<package format="3">\n  <run_depend>rospy</run_depend>\n</package>',
    good='<package format="3">\n  <exec_depend>rospy</exec_depend>\n</package>',
    found=found,
)
