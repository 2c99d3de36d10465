"""Rule ``package.dependency_form``: a dependency that makes no sense."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import msgspec

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.mistaken import hit_of
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

if TYPE_CHECKING:
    from roslens.source.workspace.mistakes import Mistake


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each dependency that is empty, on the package itself, or there twice."""
    from roslens.source.workspace.validity import DEPENDENCY, DOUBLED, ON_ITSELF

    for one in view.mistakes:
        if one.kind in (DEPENDENCY, ON_ITSELF, DOUBLED):
            edits = () if one.kind == DEPENDENCY else _removed(one, view)
            yield msgspec.structs.replace(hit_of("package.dependency_form", one), edits=edits)


def _removed(one: Mistake, view: PackageView) -> tuple[Edit, ...]:
    """Return what takes away an element that says nothing new, or names the package itself."""
    manifest = view.manifest_edits
    element = manifest.element_at(one.location.line)
    if element is None or not element.text():
        return ()
    if not one.other or manifest.format == 1 or one.other == element.tag:
        return manifest.removed(element)
    others = [each for each in manifest.elements(one.other, element.text()) if each.attributes == element.attributes]
    return manifest.removed(others[0]) if len(others) == 1 else ()


RULE = PackageRule(
    id="package.dependency_form",
    title="Dependency that is empty, doubled or on the package itself",
    finds="A dependency tag without a name, on the package itself, or that says word for word what `<depend>` says "
    "too (format 1: `<test_depend>` beside `<build_depend>` or `<run_depend>`).",
    why="catkin_pkg, which catkin, colcon, bloom and rosdep read manifests with, refuses the file: the package is "
    "left out of the build.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    fix="Takes away what is said twice, and a dependency on the package itself. An empty tag is left: "
    "somebody meant a name.",
    bad="<depend>rclcpp</depend>\n<exec_depend>rclcpp</exec_depend>",
    good="<depend>rclcpp</depend>",
    found=found,
)
