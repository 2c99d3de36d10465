"""Rule ``package.maintainer_email``: a maintainer nobody can write to."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.mistaken import mistaken
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each maintainer without address and each address that is none."""
    from roslens.source.workspace.validity import EMAIL

    yield from mistaken(view, "package.maintainer_email", EMAIL)


RULE = PackageRule(
    id="package.maintainer_email",
    title="Maintainer without e-mail address",
    finds="A `<maintainer>` without `email`, or a maintainer or author with an address that is none.",
    why="catkin_pkg, which catkin, colcon, bloom and rosdep read manifests with, refuses the file: the package is "
    "left out of the build; and there is no address to report a fault of a robot to.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad="<maintainer>Ada</maintainer>",
    good='<maintainer email="ada@example.org">Ada</maintainer>',
    found=found,
)
