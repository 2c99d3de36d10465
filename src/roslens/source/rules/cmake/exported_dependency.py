"""Rule ``cmake.exported_dependency``: what public headers include, and whoever uses the package does not get."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.system_packages import is_ros_package
from roslens.source.rules.views.cmake_view import CmakeView, Written

_AFTER = frozenset(
    {"INCLUDE_DIRS", "LIBRARIES", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS", "SKIP_CMAKE_CONFIG_GENERATION"}
)
_AUTOMATIC = ("ament_auto_package", "autoware_package", "ament_auto_find_build_dependencies")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield at once the packages that installed headers include and that the package does not export."""
    cmake = view.cmake
    export = _export(view)
    if export is None or cmake.first(*_AUTOMATIC) is not None or not cmake.first("add_library", "catkin_package"):
        return
    command, exported = export
    sought = {word for one in cmake.named("find_package") if not one.for_tests for word in one.words}
    missing: dict[str, str] = {}
    for path, facts in sorted(view.facts.items()):
        inside = view.inside(path)
        if not inside.startswith("include/") or facts.syntax != "cpp":
            continue
        for written, _ in facts.includes:
            name, slash, _ = written.strip('<>"').partition("/")
            if slash and is_ros_package(name) and name in sought and name not in exported and name != view.package.name:
                missing.setdefault(name, inside)
    if missing:
        names = ", ".join(repr(name) for name in missing)
        what = "CATKIN_DEPENDS" if command.name == "catkin_package" else "ament_export_dependencies()"
        message = f"installed headers include what is not exported: {names}; expected it in {what}"
        yield command.hit("cmake.exported_dependency", message, "exported")


def _export(view: PackageView) -> tuple[Written, set[str]] | None:
    catkin = view.cmake.first("catkin_package")
    return _of_catkin(catkin) if catkin else _of_ament(view.cmake)


def _of_catkin(catkin: Written) -> tuple[Written, set[str]] | None:
    words = list(catkin.words)
    if "INCLUDE_DIRS" not in words or any("$" in word for word in words):
        return None
    if "CATKIN_DEPENDS" not in words:
        return catkin, set()
    return catkin, set(takewhile(_is_package, words[words.index("CATKIN_DEPENDS") + 1 :]))


def _is_package(word: str) -> bool:
    return word not in _AFTER


def _of_ament(cmake: CmakeView) -> tuple[Written, set[str]] | None:
    end = cmake.first("ament_package")
    if end is None or not cmake.first("ament_export_include_directories", "ament_export_targets"):
        return None
    named = [word for one in cmake.named("ament_export_dependencies") for word in one.words]
    if any("$" in word for word in named):
        return None
    first = cmake.first("ament_export_dependencies")
    return first or end, set(named)


RULE = PackageRule(
    id="cmake.exported_dependency",
    title="Public header whose dependency is not exported",
    finds="Packages of ROS that headers below `include` include and CMakeLists.txt finds, and that neither "
    "`ament_export_dependencies` nor `CATKIN_DEPENDS` names, in a package that exports these headers. Packages "
    "built by ament_auto are left out: it exports what is declared.",
    why="Whoever includes the header has to find packages that it never names: it builds where they come from "
    "somewhere else, and fails in a workspace of its own.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("build", "dependency"),
    clauses=("catkin_lint missing_catkin_depend",),
    bad="ament_export_include_directories(include)\nament_package()  # include/arm/driver.hpp includes sensor_msgs",
    good="ament_export_include_directories(include)\nament_export_dependencies(sensor_msgs)\nament_package()",
    found=found,
)
