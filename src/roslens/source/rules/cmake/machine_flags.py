"""Rule ``cmake.machine_flags``: code for the processor that happens to compile it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Set

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_NATIVE = re.compile(r"(?<![\w-])-m(?:arch|tune|cpu)=native\b|(?<![\w-])-xHost\b")
_TUNE = "-mtune"
_SWITCH = re.compile(r"native|march|simd|sse|avx|optimi", re.IGNORECASE)

_BINARY = ("pcl", "libpcl", "gtsam", "moveit", "fcl", "libfcl", "ompl", "pinocchio", "libpointmatcher", "grid_map_core")
"""Beginnings of the names of libraries that are installed as built without the flag and take types of Eigen."""
_OFF = frozenset({"OFF", "FALSE", "0", "NO"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each flag that makes code of the building processor, where no option asks for it."""
    off = frozenset(name for one in view.cmake.commands if (name := _off(one)))
    for one in view.cmake.commands:
        if one.name in ("message", "check_cxx_compiler_flag", "option", "if") or _off(one):
            continue
        written = " ".join(argument.written for argument in one.command.arguments)
        match = _NATIVE.search(written)
        if _is_for_c_alone(one, view):
            continue
        if match is None or match[0].startswith(_TUNE) or _is_asked_for(one, off):
            continue
        message = f"{match[0]!r} makes code of the processor that builds; expected an option that is off by default"
        certainty = None if any(name.startswith(_BINARY) for name in view.named) else Certainty.HEURISTIC
        yield msgspec.structs.replace(one.hit("cmake.machine_flags", message), certainty=certainty)


def _is_for_c_alone(one: Written, view: PackageView) -> bool:
    """Return whether a command sets flags of C in a package that has no source in C."""
    if not any(word.startswith("CMAKE_C_FLAGS") for word in one.words[:1]):
        return False
    return not any(file.path.endswith(".c") for file in view.files)


def _off(one: Written) -> str:
    """Return the option that a command makes and that is off by default; empty for none."""
    if one.name == "option" and one.words:
        return one.words[0] if one.words[2:3] == () or one.words[2].upper() in _OFF else ""
    if one.name == "set" and one.words[2:4] == ("CACHE", "BOOL") and one.words[1].upper() in _OFF:
        return one.words[0]
    return ""


def _is_asked_for(one: Written, off: Set[str]) -> bool:
    """Return whether a condition around a command names what the processor can do, or an option that is off."""
    return any(_SWITCH.search(each) or each.strip("${}") in off for each in one.conditions)


RULE = PackageRule(
    id="cmake.machine_flags",
    title="Code of the processor that happens to build it",
    finds="`-march=native` (or `-mcpu=native`) without an option that is off by default: `option(USE_NATIVE … OFF)`, "
    "or `set(USE_NATIVE OFF CACHE BOOL …)`. In a package that uses no library with types of Eigen which comes built, "
    "such as PCL, it is a note: what is built on the robot runs there.",
    why="What is built on a workstation or in CI ends with an illegal instruction on the robot's smaller "
    "processor; and Eigen lays its types out differently with it, so that packages built without it crash when "
    "they meet.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad='set(CMAKE_CXX_FLAGS "${CMAKE_CXX_FLAGS} -march=native")',
    good='option(USE_NATIVE "Code of this processor only" OFF)\nif(USE_NATIVE)\n  add_compile_options(-march=native)\n'
    "endif()",
    found=found,
)
