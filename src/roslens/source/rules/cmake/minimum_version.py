"""Rule ``cmake.minimum_version``: no ``cmake_minimum_required``, or of a CMake that is no longer supported."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

OLDEST = (3, 5)
"""CMake 4 refuses what asks for an older one."""
_ROS_1 = re.compile(r"ROS_VERSION\W+(?:EQUAL|STREQUAL)\W+1\b|catkin_FOUND")
_VERSION = re.compile(r"(\d+)\.(\d+)(?:\.\d+)*(?:\.\.\.(\d+)\.(\d+))?")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the project without a minimum, or the minimum that CMake 4 refuses."""
    cmake = view.cmake
    if not cmake.exists or not cmake.commands:
        return
    asked = [one for one in cmake.named("cmake_minimum_required") if one.path == cmake.top]
    if asked and all(_is_for_ros_1(one) for one in asked):
        return
    command = next((one for one in asked if not _is_for_ros_1(one)), None)
    if command is None:
        project = cmake.first("project")
        if project is not None and project.path == cmake.top:
            message = "no cmake_minimum_required() before project(); expected one as the first command"
            yield project.hit("cmake.minimum_version", message)
        return
    version = next((match for word in command.words if (match := _VERSION.match(word))), None)
    if version is None or 2 not in view.ros or _is_of_catkin_alone(view):
        return
    highest = tuple(int(one) for one in (version.group(3, 4) if version[3] else version.group(1, 2)))
    if highest < OLDEST:
        message = f"the minimum is CMake {version[0]}, which CMake 4 refuses; expected at least 3.5"
        yield command.hit("cmake.minimum_version", message)


def _is_of_catkin_alone(view: PackageView) -> bool:
    """Return whether the file is one of ROS 1, whatever the manifest says for ROS 2."""
    looked_for = {word for one in view.cmake.named("find_package") for word in one.words[:1]}
    return "catkin" in looked_for and not any(name.startswith("ament_cmake") for name in looked_for)


def _is_for_ros_1(one: Written) -> bool:
    return any(_ROS_1.search(condition) for condition in one.conditions)


RULE = PackageRule(
    id="cmake.minimum_version",
    title="Missing or outdated minimum of CMake",
    finds="A CMakeLists.txt without `cmake_minimum_required()`, or, in a package for ROS 2, with one below 3.5. "
    "Ask for a version that the oldest distribution you build for has, or for a range: `VERSION 3.8...3.28`.",
    why="The minimum chooses the policies by which CMake reads the file. CMake 4 stops with an error where it is "
    "below 3.5, and without any it warns and takes behaviour of 2.4.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad="project(driver)\nadd_executable(driver src/driver.cpp)",
    good="cmake_minimum_required(VERSION 3.8)\nproject(driver)\nadd_executable(driver src/driver.cpp)",
    found=found,
)
