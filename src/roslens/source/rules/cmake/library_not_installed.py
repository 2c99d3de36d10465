"""Rule ``cmake.library_not_installed``: libraries that others are promised and never get."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_AFTER = frozenset({"INCLUDE_DIRS", "CATKIN_DEPENDS", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS"})
_NOT_BUILT = frozenset({"IMPORTED", "INTERFACE", "ALIAS"})
_AUTOMATIC = ("ament_auto_package", "autoware_package")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each library of the package that is exported and that no rule installs."""
    cmake = view.cmake
    if cmake.first(*_AUTOMATIC) is not None:
        return
    made = {
        one.words[0]
        for one in cmake.named("add_library", "cuda_add_library")
        if one.words and not one.conditions and _NOT_BUILT.isdisjoint(one.words)
    }
    installed: set[str] = set()
    for one in cmake.commands:
        if "install" not in one.name or "python" in one.name:
            continue
        if any("$" in word for word in one.words[1:3]):
            return
        installed.update(one.words)
    for command, name in _exported(view):
        if name in made and name not in installed and "$" not in name:
            message = f"library {name!r} is exported and not installed; expected install(TARGETS {name} …)"
            hit = command.hit("cmake.library_not_installed", message, name)
            yield msgspec.structs.replace(hit, certainty=None if 2 in view.ros else Certainty.HEURISTIC)


def _exported(view: PackageView) -> Iterator[tuple[Written, str]]:
    for one in view.cmake.named("ament_export_libraries"):
        if not one.conditions:
            for word in one.words:
                yield one, word
    command = view.cmake.first("catkin_package")
    if command is not None and "LIBRARIES" in command.words and not command.conditions:
        for word in command.words[command.words.index("LIBRARIES") + 1 :]:
            if word in _AFTER:
                return
            yield command, word


RULE = PackageRule(
    id="cmake.library_not_installed",
    title="Library that is exported and not installed",
    finds="A library that `ament_export_libraries` or `catkin_package(LIBRARIES …)` names and that no "
    "`install(TARGETS …)` does. In ROS 1 it is a note: the devel space finds it.",
    why="Packages that link it build beside its source and nowhere else; a plug-in in it is not found on the robot.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("build", "install"),
    clauses=("catkin_lint exported library is not installed",),
    bad="add_library(driver src/driver.cpp)\nament_export_libraries(driver)\nament_package()",
    good="add_library(driver src/driver.cpp)\ninstall(TARGETS driver DESTINATION "
    "lib)\nament_export_libraries(driver)\nament_package()",
    found=found,
)
