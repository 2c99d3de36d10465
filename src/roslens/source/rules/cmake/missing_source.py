"""Rule ``cmake.missing_source``: a target is made of a file that does not exist."""

from __future__ import annotations

import re
from collections.abc import Iterator
from posixpath import basename, dirname

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written

_MAKES = ("add_executable", "add_library", "ament_add_gtest", "catkin_add_gtest", "cuda_add_executable", "nodelet")
_SOURCE = re.compile(r"[\w./+-]+\.(?:c|cc|cpp|cxx|cu)$")
_VARIABLE = re.compile(r"\$\{(\w+)\}")
_CHANGES = ("set", "list", "file", "aux_source_directory", "string", "unset")
"""Commands that give a variable another value."""
_GENERATES = (
    "add_custom_command",
    "configure_file",
    "execute_process",
    "qt5_wrap_ui",
    "qt_wrap_cpp",
    "externalproject_add",
)


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each source that is written out, not in the package and made by no command."""
    cmake = view.cmake
    made = " ".join(" ".join(one.words) for one in cmake.named(*_GENERATES, "file"))
    for one in cmake.named(*_MAKES):
        if one.defined:
            continue
        for word in _sources(one, view):
            path = cmake.inside(word, one) if basename(word) not in made else None
            if path is None or view.exists(path) or not _is_below(path, view.folder) or _is_elsewhere(path, view):
                continue
            sure = not one.conditions and one.name in ("add_executable", "add_library")
            message = f"source {word!r} of target {one.words[0]!r} does not exist; expected a file of the package"
            yield _weighed(one.hit("cmake.missing_source", message, word), sure=sure)


def _sources(one: Written, view: PackageView) -> Iterator[str]:
    """Yield the sources that a command names itself, or by a variable that has one value."""
    for argument in one.command.arguments[1:]:
        words = _listed(argument.written, view) if argument.literal is None else (argument.literal,)
        yield from (word for word in words if _SOURCE.fullmatch(word))


def _listed(written: str, view: PackageView) -> Iterator[str]:
    """Yield the words of a variable that the package sets once, outside of any condition, and adds nothing to."""
    match = _VARIABLE.fullmatch(written)
    if match is None:
        return
    setting = [one for one in view.cmake.commands if match[1] in one.words and one.name != "foreach"]
    sets = [one for one in setting if one.name == "set" and one.words[0] == match[1]]
    changed = [one for one in setting if one.name in _CHANGES and one not in sets]
    if len(sets) == 1 and not changed and not sets[0].conditions and not sets[0].inside:
        yield from (one.literal for one in sets[0].command.arguments[1:] if one.literal is not None)


def _is_below(path: str, folder: str) -> bool:
    return not path.startswith("..") and (not folder or path.startswith(f"{folder}/"))


def _is_elsewhere(path: str, view: PackageView) -> bool:
    """Return whether the folder of a path is there and empty: that of a submodule, which was not cloned."""
    folder = dirname(path)
    return (
        bool(folder)
        and view.exists(folder)
        and not any(view.path(one).startswith(f"{folder}/") for one in view.listing)
    )


def _weighed(hit: Hit, *, sure: bool) -> Hit:
    import msgspec

    return hit if sure else msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)


RULE = PackageRule(
    id="cmake.missing_source",
    title="Target of a source that does not exist",
    finds="A source that `add_executable` or `add_library` names, itself or by a variable that is set once, and that "
    "is neither in the package nor made by a command. Correct the path, or remove the target. Inside a condition it "
    "is a note: that arm may never run.",
    why="CMake stops: the package cannot be built at all.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad="add_executable(driver src/drvier.cpp)",
    good="add_executable(driver src/driver.cpp)",
    found=found,
)
