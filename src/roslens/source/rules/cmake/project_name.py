"""Rule ``cmake.project_name``: the project is not named as the package."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_ENDS = ("catkin_package", "ament_package", "ament_auto_package", "ament_export_dependencies")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield ``project()`` where its name differs from the package's."""
    cmake = view.cmake
    name = cmake.project()
    project = cmake.first("project")
    if not name or project is None or name == view.package.name or project.path != cmake.top:
        return
    if cmake.first(*_ENDS) is not None:
        message = f"the project is {name!r}, the package {view.package.name!r}; expected the name of the package"
        yield project.hit("cmake.project_name", message)


RULE = PackageRule(
    id="cmake.project_name",
    title="Project not named as its package",
    finds="A `project()` in CMakeLists.txt whose name differs from the `<name>` in package.xml, in a package that "
    "catkin or ament exports. Give both the same name.",
    why="catkin and ament install and export by the name of the project, everybody else looks for the name of the "
    "package: it is not found, or its files are installed where nobody looks.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad="project(laser_driver)  # package.xml: <name>laser_drivers</name>",
    good="project(laser_drivers)",
    found=found,
)
