"""Rule ``cmake.program_not_installed``: a program that is built and not installed."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import CmakeView, Written

_MAKES = ("add_executable", "ament_auto_add_executable", "cuda_add_executable")
_ASIDE = frozenset({"test", "tests", "examples", "example", "benchmark", "benchmarks"})
_GATHERS = ("ament_auto_package", "ament_auto_install", "autoware_ament_auto_package")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each executable that no rule installs, in a package that installs others or is for ROS 2."""
    cmake = view.cmake
    if cmake.first(*_GATHERS) is not None or cmake.first("ament_package", "catkin_package") is None:
        return
    installed = list(cmake.named("install", "install_targets", "ros_install_targets"))
    if any("$" in word for one in installed if one.words[:1] == ("TARGETS",) for word in one.words[1:2]):
        return
    names = {word for one in installed for word in one.words}
    for one in cmake.named(*_MAKES):
        if one.defined or one.for_tests or one.conditions or not one.words or "$" in one.words[0]:
            continue
        name = one.words[0]
        if name in names or _is_for_the_build(one, cmake):
            continue
        message = f"executable {name!r} is built and not installed; expected install(TARGETS {name} …)"
        certainty = None if 2 in view.ros else Certainty.HEURISTIC
        hit = one.hit("cmake.program_not_installed", message, name)
        yield msgspec.structs.replace(hit, certainty=certainty)


def _is_for_the_build(one: Written, cmake: CmakeView) -> bool:
    """Whether an executable is for the build, for tests or for developers, who run it from where it is built."""
    name, *words = one.words
    if {"EXCLUDE_FROM_ALL", "IMPORTED", "ALIAS"} & set(one.words) or _is_aside(one.path, name):
        return True
    if any(_is_aside(word, "") for word in words):
        return True
    used = [each for each in cmake.commands if each is not one and name in each.words]
    return any(each.name in ("add_test", "add_custom_command", "ament_add_test", "add_rostest") for each in used)


def _is_aside(path: str, name: str) -> bool:
    folders = path.lower().split("/")[:-1]
    return "test" in name.lower() or bool(_ASIDE & set(folders))


RULE = PackageRule(
    id="cmake.program_not_installed",
    title="Program that is not installed",
    finds="An executable, built outside of conditions, tests and examples, that no `install(TARGETS …)` names. In "
    "ROS 1 it is a note: the devel space finds it.",
    why='`ros2 run` and launch files look into the installation: "executable not found" on the robot.',
    consequence=Consequence.STOPS_START,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("build", "install"),
    bad="add_executable(driver src/driver.cpp)\nament_package()",
    good="add_executable(driver src/driver.cpp)\ninstall(TARGETS driver DESTINATION "
    "lib/${PROJECT_NAME})\nament_package()",
    found=found,
)
