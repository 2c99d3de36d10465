"""Rule ``package.required_tag``: a manifest lacks what it must have."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.mistaken import mistaken
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each tag that is missing, empty or there twice."""
    from roslens.source.workspace.validity import REQUIRED

    yield from mistaken(view, "package.required_tag", REQUIRED)


RULE = PackageRule(
    id="package.required_tag",
    title="Manifest without what it must have",
    finds="A package.xml without `<version>`, `<description>`, `<maintainer>` or `<license>`, with one of them "
    "empty, or with a second `<name>`, `<version>`, `<description>` or `<export>`.",
    why="catkin_pkg, which catkin, colcon, bloom and rosdep read manifests with, refuses the file: the package is "
    "left out of the build.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad='<package format="3"><name>driver</name></package>',
    good="<version>0.1.0</version>\n<description>Drives the base.</description>\n"
    '<maintainer email="ada@example.org">Ada</maintainer>\n<license>Apache-2.0</license>',
    found=found,
)
