"""Rule ``package.dependency_form``: a dependency that makes no sense."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.finding import Severity
from roslens.source.rules.hit import Hit
from roslens.source.rules.mistaken import mistaken
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each dependency that is empty, on the package itself, or there twice."""
    from roslens.source.workspace.validity import DEPENDENCY

    yield from mistaken(view, "package.dependency_form", DEPENDENCY)


RULE = PackageRule(
    id="package.dependency_form",
    title="Dependency that is empty, doubled or on the package itself",
    finds="A dependency tag without a name, on the package itself, or that says word for word what `<depend>` says "
    "too (format 1: `<test_depend>` beside `<build_depend>` or `<run_depend>`).",
    why="catkin_pkg, which catkin, colcon, bloom and rosdep read manifests with, refuses the file: the package is "
    "left out of the build.",
    severity=Severity.ERROR,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad="<depend>rclcpp</depend>\n<exec_depend>rclcpp</exec_depend>",
    good="<depend>rclcpp</depend>",
    found=found,
)
