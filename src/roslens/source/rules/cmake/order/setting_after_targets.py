"""Rule ``cmake.setting_after_targets``: a setting for all targets that comes when these are made already."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_MADE = ("add_executable", "add_library")
_MAKES = re.compile(
    r"\w*add_\w*(?:executable|library|module|node|nodelet|component|plugin|gtest|gmock|benchmark|subdirectory)"
    r"|rosidl_generate_interfaces|fetchcontent_makeavailable|include|nodelet|\w*generate_\w+"
)
"""Commands that make targets, or may."""
_COMMANDS = ("add_compile_options", "link_directories", "link_libraries")
_VARIABLES = frozenset({
    "CMAKE_CXX_STANDARD", "CMAKE_CXX_STANDARD_REQUIRED", "CMAKE_CXX_EXTENSIONS", "CMAKE_C_STANDARD",
    "CMAKE_POSITION_INDEPENDENT_CODE", "CMAKE_RUNTIME_OUTPUT_DIRECTORY", "CMAKE_LIBRARY_OUTPUT_DIRECTORY",
    "CMAKE_INSTALL_RPATH", "CMAKE_AUTOMOC", "CMAKE_AUTOUIC", "CMAKE_AUTORCC", "CMAKE_CXX_VISIBILITY_PRESET",
})  # fmt: skip
"""A target takes the values that these have when it is made."""
_WEIGHTY = frozenset({"CMAKE_CXX_STANDARD", "CMAKE_C_STANDARD"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first setting of each file that no target comes behind, and that would have served those before."""
    files: dict[str, list[Written]] = {}
    for one in view.cmake.commands:
        files.setdefault(one.path, []).append(one)
    for commands in files.values():
        yield from _late(commands)


def _late(commands: list[Written]) -> Iterator[Hit]:
    """Yield the setting of a file that comes behind all its targets."""
    made = [number for number, one in enumerate(commands) if _is_target(one)]
    last = max((number for number, one in enumerate(commands) if _MAKES.fullmatch(one.name)), default=-1)
    late = [one for one in commands[last + 1 :] if made and not one.defined and not one.conditions and _setting(one)]
    # A value that was set before, too, serves the targets.
    earlier = {_setting(one) for one in commands[: last + 1]}
    late = [one for one in late if _setting(one) not in earlier]
    if not late:
        return
    first = next((one for one in late if _setting(one) in _WEIGHTY), late[0])
    names = ", ".join(f"{_setting(one)!r}" for one in late if one is not first)
    besides = f" ({names} too)" if names else ""
    target = commands[made[0]]
    yield first.hit(
        "cmake.setting_after_targets",
        f"{first.text!r} comes behind all targets{besides}, and holds for none of them; expected it before "
        f"{target.words[0]!r} in line {target.command.line}",
    )


def _is_target(one: Written) -> bool:
    kinds = {"IMPORTED", "ALIAS", "INTERFACE"}
    return one.name in _MADE and bool(one.words) and not kinds.intersection(one.words)


def _setting(one: Written) -> str:
    """Return what a command sets for all targets that come behind it; empty where it sets nothing of the kind."""
    if one.name in _COMMANDS:
        return one.name
    return one.words[0] if one.name == "set" and len(one.words) > 1 and one.words[0] in _VARIABLES else ""


RULE = PackageRule(
    id="cmake.setting_after_targets",
    title="Setting for all targets that comes behind them",
    finds="`set(CMAKE_CXX_STANDARD …)`, `add_compile_options`, `link_directories` and the like behind the last target "
    "of a CMakeLists.txt, outside of conditions, where nothing set it before. Set it above the first target.",
    why="A target takes what is set when it is made: it is compiled by the standard and the warnings that the compiler "
    "has of its own, which the next compiler has others of.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad="add_executable(driver src/driver.cpp)\nset(CMAKE_CXX_STANDARD 17)",
    good="set(CMAKE_CXX_STANDARD 17)\nadd_executable(driver src/driver.cpp)",
    found=found,
)
