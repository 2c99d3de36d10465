"""Sources of C++ that are in no target of a package: nothing compiles them, and what they do happens on no robot.

It is known only where the CMake files name all sources, and nothing else builds some of them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from pathlib import PurePosixPath

import msgspec

from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

_FAMILIES = ("node.", "cpp.")
_SOURCES = frozenset({".c", ".cc", ".cpp", ".cxx"})
_TARGETS = ("add_executable", "add_library", "target_sources")
_AUTOMATIC = ("_auto_", "cs_add_", "autoware_package")
"""Parts of the names of commands that look for sources themselves."""
_OTHER_BUILDS = frozenset({"Makefile", "makefile", "platformio.ini", "meson.build", "BUILD", "SConstruct"})
_OTHER_ENDINGS = frozenset({".ino", ".pro", ".vcxproj", ".mk", ".gyp", ".bazel"})
_EXTENSIONS = b"ext_modules"
"""What setup.py says where it compiles something itself."""


def as_notes_of_unbuilt_sources(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; what a node or its C++ does is a note in a source that is in no target.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    found = {path: list(hits) for path, hits in placed.items()}
    flagged = [path for path, hits in found.items() if _suffix(path) in _SOURCES and any(map(_is_asked, hits))]
    if not flagged or not _names_all_sources(view):
        return found
    mentioned = _mentioned(view)
    for path in flagged:
        if _stem(path) not in mentioned and not view.cmake.may_build(path):
            found[path] = [_as_note(hit) for hit in found[path]]
    return found


def _names_all_sources(view: PackageView) -> bool:
    """Return whether the targets of a package are made of names alone, and nothing but its CMake files builds it."""
    if view.package.id == OUTSIDE_PACKAGES or view.cmake.first("add_executable", "add_library") is None:
        return False
    if any(part in one.name for one in view.cmake.commands for part in _AUTOMATIC):
        return False
    if any("$" in word.replace("$<TARGET_OBJECTS", "") for one in view.cmake.named(*_TARGETS) for word in one.words):
        return False
    if _EXTENSIONS in view.read(view.path("setup.py")):
        return False
    return not any(PurePosixPath(one).name in _OTHER_BUILDS or _suffix(one) in _OTHER_ENDINGS for one in view.listing)


def _mentioned(view: PackageView) -> Set[str]:
    """Return the names, without endings, of the files that commands name or other files include."""
    named = {_stem(word) for one in view.cmake.commands for word in one.words}
    included = (include.strip('<>"') for facts in view.facts.values() for include, _ in facts.includes)
    return named | {_stem(one) for one in included if _suffix(one) in _SOURCES}


def _stem(path: str) -> str:
    return PurePosixPath(path).name.partition(".")[0]


def _suffix(path: str) -> str:
    return PurePosixPath(path).suffix


def _is_asked(hit: Hit) -> bool:
    return hit.rule.startswith(_FAMILIES)


def _as_note(hit: Hit) -> Hit:
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) if _is_asked(hit) else hit
