"""Rule ``cmake.language_standard``: the standard of C++ is a flag for all that is compiled."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_COMPILES = re.compile(
    r"\w*add_\w*(?:executable|library|module|node|nodelet|component|plugin|gtest|gmock|benchmark)"
    r"|rosidl_generate_interfaces|add_subdirectory|fetchcontent_makeavailable|\w+_package"
)
"""Commands that have something compiled. An interface of ROS 2 is; a message of ROS 1 is a header."""
_NO_TARGETS = frozenset({"catkin_package", "ament_package", "catkin_metapackage", "find_package"})
_OLD = frozenset({"98", "03", "0x", "11"})
_OLD_IN_ROS2 = frozenset({"1y", "14"})
_STANDARD = re.compile(r"-std=(?:c|gnu)\+\+(\w+)")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each command that adds ``-std=`` to the flags of all targets, where there are any."""
    if not _compiles(view):
        return
    for one in view.cmake.named("add_definitions", "add_compile_options", "set"):
        if one.name == "set" and one.words[:1] not in (("CMAKE_CXX_FLAGS",), ("CMAKE_C_FLAGS",)):
            continue
        if one.defined or one.conditions:
            continue
        written = " ".join(argument.written for argument in one.command.arguments)
        if match := _STANDARD.search(written):
            message = f"{match[0]!r} for all targets; expected CMAKE_CXX_STANDARD, or target_compile_features()"
            certainty = None if _is_too_old(match[1], view) else Certainty.HEURISTIC
            yield msgspec.structs.replace(one.hit("cmake.language_standard", message), certainty=certainty)


def _is_too_old(standard: str, view: PackageView) -> bool:
    """Return whether what a package is for, or uses, needs a newer standard in current distributions."""
    if 2 in view.ros:
        return standard in (*_OLD, *_OLD_IN_ROS2)
    return standard in _OLD and any(name.startswith("pcl") for name in view.named)


def _compiles(view: PackageView) -> bool:
    """Return whether a package has anything compiled."""
    names = {one.name for one in view.cmake.commands} - _NO_TARGETS
    return any(_COMPILES.fullmatch(one) for one in names)


RULE = PackageRule(
    id="cmake.language_standard",
    title="Standard of C++ as a flag for everything",
    finds="`-std=c++…` in `add_definitions`, `add_compile_options` or `CMAKE_CXX_FLAGS`, outside of any condition, "
    "where something is compiled. "
    "Set `CMAKE_CXX_STANDARD`, or ask for `target_compile_features(… cxx_std_17)`. It is a note where the standard is "
    "one that current distributions build with, and in ROS 1 where the package does not use PCL.",
    why="Headers of newer distributions need a newer standard (Noetic's log4cxx and PCL need C++14, ROS 2 needs "
    "C++17): the flag pins the old one, overrules what dependencies ask for, and the package no longer builds.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad="add_compile_options(-std=c++11)",
    good="set(CMAKE_CXX_STANDARD 17)",
    found=found,
)
