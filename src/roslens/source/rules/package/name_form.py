"""Rule ``package.name_form``: the name of a package is none."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.mistaken import mistaken
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the name that has other characters than names may have."""
    from roslens.source.workspace.validity import NAME

    yield from mistaken(view, "package.name_form", NAME)


RULE = PackageRule(
    id="package.name_form",
    title="Name that no package may have",
    finds="A `<name>` with other characters than letters, digits, `_` and `-`, or that begins with one of the last "
    "two.",
    why="catkin_pkg, which catkin, colcon, bloom and rosdep read manifests with, refuses the file: the package is "
    "left out of the build.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad="<name>arm driver</name>",
    good="<name>arm_driver</name>",
    found=found,
)
