"""Rule ``package.version_form``: a version that is no version."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.mistaken import mistaken
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each version that is not three numbers."""
    from roslens.source.workspace.validity import VERSION

    yield from mistaken(view, "package.version_form", VERSION)


RULE = PackageRule(
    id="package.version_form",
    title="Version that is not three numbers",
    finds="A `<version>`, or its `compatibility`, that is not of three numbers. What a template leaves open "
    "(`@VERSION@`, `:{version}`) is no mistake, here and in the other rules on manifests.",
    why="catkin_pkg, which catkin, colcon, bloom and rosdep read manifests with, refuses the file: the package is "
    "left out of the build, and no release can be made.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad="<version>1.0</version>",
    good="<version>1.0.0</version>",
    found=found,
)
