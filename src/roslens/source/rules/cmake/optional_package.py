"""Rule ``cmake.optional_package``: a package is looked for as if it were optional, and used as if it were there."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_QUICKER = frozenset({"openmp", "mpi", "cuda", "tbb"})
"""What makes a program quicker where it is there: without it the variables are empty, and the build is in order."""
_BUILD_SYSTEMS = frozenset({"catkin", "ament_cmake", "ament_cmake_auto"})
"""Without them the next command of the file does not exist, and the build ends there."""
_CHECKS = frozenset({"find_package_handle_standard_args", "ament_auto_find_build_dependencies"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each ``find_package`` without ``REQUIRED`` whose result nobody asks for."""
    cmake = view.cmake
    text = cmake.text
    for one in cmake.named("find_package"):
        if _is_required(one) or one.defined or not one.command.arguments or one.for_tests:
            continue
        name = one.command.arguments[0].literal
        if (
            name is None
            or name.lower() in _QUICKER
            or name in _BUILD_SYSTEMS
            or _is_asked(name, text)
            or _stops_configuring(name, view)
            or cmake.first(*_CHECKS)
        ):
            continue
        if any(_required_too(other, name) for other in cmake.named("find_package")):
            continue
        if _is_used(name, view):
            message = f"{name!r} is searched for without REQUIRED and used without a check whether it was found"
            yield one.hit("cmake.optional_package", message)


def _is_required(command: Written) -> bool:
    # What is not REQUIRED and QUIET is meant to be optional.
    return any(word in ("REQUIRED", "QUIET", "OPTIONAL_COMPONENTS") for word in command.words)


def _required_too(command: Written, name: str) -> bool:
    return "REQUIRED" in command.words and command.words[:1] == (name,)


def _is_asked(name: str, text: str) -> bool:
    return re.search(rf"\b{re.escape(name)}_(?:FOUND|DIR|VERSION)\b", text, re.IGNORECASE) is not None or (
        re.search(rf"TARGET\s+{re.escape(name)}::", text) is not None
    )


def _stops_configuring(name: str, view: PackageView) -> bool:
    """Return whether a command names the package that ends configuring itself where it was not found."""
    return any(
        name in one.words
        for one in view.cmake.named("ament_target_dependencies")
        if not (one.conditions or one.defined)
    )


def _is_used(name: str, view: PackageView) -> bool:
    pattern = re.compile(rf"\$\{{{re.escape(name)}_\w+\}}|\b{re.escape(name)}::", re.IGNORECASE)
    uses = view.cmake.named("target_link_libraries", "include_directories", "target_include_directories")
    return any(
        pattern.search(argument.written) for one in uses if not one.conditions for argument in one.command.arguments
    )


RULE = PackageRule(
    id="cmake.optional_package",
    title="Needed package looked for as if it were optional",
    finds="A `find_package()` without `REQUIRED` of what is then linked or included in any case, and whose "
    "`…_FOUND` is never asked. Add `REQUIRED`. OpenMP, MPI, CUDA and TBB may be missing, and "
    "`ament_target_dependencies()` asks for what it is given itself.",
    why="Where it is missing, configuring goes on and the build ends with a header or symbol that cannot be found, "
    "far from the cause, or links without it.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad="find_package(Eigen3)\ninclude_directories(${EIGEN3_INCLUDE_DIRS})",
    good="find_package(Eigen3 REQUIRED)\ninclude_directories(${EIGEN3_INCLUDE_DIRS})",
    found=found,
)
