"""Rule ``cmake.missing_target``: a command on a target that nothing makes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_ON_TARGET = frozenset({
    "target_link_libraries", "target_include_directories", "target_compile_definitions", "target_compile_options",
    "target_compile_features", "target_sources", "ament_target_dependencies", "set_target_properties",
    "add_dependencies", "rosidl_target_interfaces",
})  # fmt: skip
"""Commands whose first argument is a target that has to be there."""
_MAKES = frozenset({
    "add_library", "add_executable", "ament_auto_add_library", "ament_auto_add_executable", "catkin_add_gtest",
    "ament_add_gtest", "ament_add_gmock", "add_custom_target", "cuda_add_executable", "cuda_add_library",
    "pybind11_add_module", "generate_parameter_library", "rosidl_generate_interfaces", "add_rostest_gtest",
})  # fmt: skip
_OPEN = frozenset({
    "add_subdirectory", "include", "fetchcontent_makeavailable", "fetchcontent_populate", "function", "macro",
    "ament_auto_generate_code", "subdirs",
})  # fmt: skip
"""What may make targets that are not seen: what is not read, and what is made where a function is called."""
_OF_PROJECT = re.compile(r"[\w.+-]+")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each name that only commands on targets have, the first of each name."""
    commands = view.cmake.commands
    made = _made(commands)
    if not made or any(one.name in _OPEN or one.defined for one in commands):
        return
    named = {word for one in commands if one.name not in (*_ON_TARGET, "install") for word in one.words}
    reported: set[str] = set()
    for one in commands:
        for target in _needed(one):
            if target in named or target in reported or not _OF_PROJECT.fullmatch(target):
                continue
            reported.add(target)
            near = get_close_matches(target, made, 1)
            meant = f"`{near[0]}`" if near else f"one of {', '.join(sorted(made))}"
            message = f"{one.name} is for target `{target}`, which nothing in this package makes; expected {meant}"
            yield one.hit("cmake.missing_target", message, target)


def _made(commands: tuple[Written, ...]) -> set[str]:
    return {one.words[0] for one in commands if one.name in _MAKES and one.words and "$" not in one.words[0]}


def _needed(one: Written) -> Iterator[str]:
    """Yield the targets that a command needs, where it runs for certain."""
    if one.conditions or one.inside or not one.words:
        return
    if one.name in _ON_TARGET:
        yield one.words[0]
    if one.name == "install" and one.words[0] == "TARGETS":
        for word in one.words[1:]:
            if word.isupper():
                return
            yield word


RULE = PackageRule(
    id="cmake.missing_target",
    title="Command on a target that nothing makes",
    finds="`target_link_libraries`, `target_include_directories`, `ament_target_dependencies`, `install(TARGETS ...)` "
    "and the like for a name that no `add_executable`, `add_library` or other command of the package has: misspelt, or "
    "left behind when the target was renamed. Nothing is reported where other files, functions or macros may make "
    "targets, or the command is in an `if` or a loop.",
    why="CMake ends with «Cannot specify link libraries for target … which is not built by this project», or "
    "«install TARGETS given target … which does not exist».",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad="add_executable(driver src/driver.cpp)\ntarget_link_libraries(drivr rclcpp::rclcpp)\n",
    good="add_executable(driver src/driver.cpp)\ntarget_link_libraries(driver rclcpp::rclcpp)\n",
    found=found,
)
