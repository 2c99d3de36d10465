"""Rule ``cmake.package_name``: a word that is no package, where ament needs packages that were found."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.likeness import distance
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.system_packages import OF_THE_CORE
from roslens.source.rules.views.cmake_view import Written

_ID = "cmake.package_name"
_USES, _EXPORTS = "ament_target_dependencies", "ament_export_dependencies"
_KEYWORDS = frozenset({"INTERFACE", "PUBLIC", "PRIVATE", "SYSTEM"})
_TARGET = re.compile(r"([\w.+-]+)::[\w.+-]+")
_WORD = re.compile(r"[A-Za-z][\w.+-]*")
_SHORTEST, _LONG = 6, 10
"""Letters: shorter names differ by one and mean two packages, in long ones two are mistaken."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each target among names of packages, and each name that is almost that of a package that was found."""
    commands = view.cmake.commands
    looked_for = _looked_for(commands)
    for one in commands:
        if not one.defined and one.name in (_USES, _EXPORTS):
            yield from _wrong(one, looked_for, view)


def _wrong(one: Written, looked_for: frozenset[str], view: PackageView) -> Iterator[Hit]:
    for word in one.words[1 if one.name == _USES else 0 :]:
        if target := _TARGET.fullmatch(word):
            yield one.hit(_ID, _of_target(one.name, word, target[1]), word)
        elif near := _near(word, looked_for, view):
            effect = "CMake ends there" if one.name == _USES else "what depends on this package ends there"
            message = f"{one.name} is given {word!r}, which no find_package looks for: {effect}; expected {near!r}"
            # What another package looks for counts as found too; that it does not look for this is not known for sure.
            yield msgspec.structs.replace(one.hit(_ID, message, word), certainty=Certainty.LIKELY)


def _looked_for(commands: tuple[Written, ...]) -> frozenset[str]:
    """Return whatever ``find_package`` and its like name; components are among it."""
    finding = ("find_package", "ament_auto_find_build_dependencies", "find_dependency", "pkg_check_modules")
    return frozenset(word for one in commands if one.name in finding for word in one.words)


def _of_target(command: str, word: str, package: str) -> str:
    if command == _USES:
        return (
            f"{command} is given the target {word!r}, and takes packages that were found: CMake ends there; expected "
            f"`target_link_libraries(… {word})`, or {package!r}"
        )
    return (
        f"{command} is given the target {word!r}: what depends on this package looks for a package of that name and "
        f"ends there; expected {package!r}"
    )


def _near(word: str, looked_for: frozenset[str], view: PackageView) -> str:
    """Return the package that a word is a misspelling of; empty where it may be one by itself.

    What a package that was found looks for itself counts as found too, so that a name that some package has is right.
    """
    written = {one.lower() for one in looked_for} | view.named
    known = word.lower() in written or word in OF_THE_CORE or word in _KEYWORDS
    if known or len(word) < _SHORTEST or not _WORD.fullmatch(word):
        return ""
    most = 2 if len(word) >= _LONG else 1
    near = (one for one in sorted(looked_for) if _digits(one) == _digits(word) and distance(word, one, most) <= most)
    return next(near, "")


def _digits(name: str) -> str:
    return "".join(filter(str.isdigit, name))


RULE = PackageRule(
    id=_ID,
    title="Name that is no package, where CMake needs one",
    finds="A target (`rclcpp::rclcpp`) in `ament_target_dependencies` or `ament_export_dependencies`, which take "
    "names of packages; and a name there that no `find_package` looks for, that no manifest and no package of the "
    "core of ROS has, and that differs by a letter or two from one that is looked for: `rclutils` for `rcutils`.",
    why="CMake ends with «the passed package name … was not found before»; what is exported wrongly stops the build of "
    "each package that depends on this one.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("build", "dependency"),
    bad="find_package(rcutils REQUIRED)\nament_target_dependencies(driver rclutils)\n",
    good="find_package(rcutils REQUIRED)\nament_target_dependencies(driver rcutils)\n",
    found=found,
)
