"""Scripts of a package for ROS 2 of which its CMake files say nothing: what a port to ROS 2 left behind.

They are neither installed nor run by the build, so that what Python cannot read in them stops nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from posixpath import basename

import msgspec

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.views.cmake_view import Written

_RULES = frozenset({"python.python2_syntax", "python.python2_name", "python.syntax"})
_AUTOMATIC = ("ament_auto_package", "autoware_package")
_READ_ONLY = frozenset({"message", "project", "find_package", "if", "elseif"})
_INSTALLED = frozenset({"FILES", "PROGRAMS", "DIRECTORY"})


def as_notes_of_unused_scripts(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; what Python 3 cannot read is a note in a script that the build does not name.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    found = {path: list(hits) for path, hits in placed.items()}
    flagged = [path for path, hits in found.items() if any(hit.rule in _RULES for hit in hits)]
    if not flagged or view.ros != {2} or not view.cmake.commands or view.cmake.first(*_AUTOMATIC) is not None:
        return found
    named = list(_named(view))
    for path in flagged:
        if not any(_covers(one, view.inside(path)) for one in named):
            found[path] = [_as_note(hit) for hit in found[path]]
    return found


def _named(view: PackageView) -> Iterator[str]:
    """Yield the paths below the package that commands may name; empty for what may be any."""
    for one in view.cmake.commands:
        if one.name not in _READ_ONLY:
            yield from _paths(one, view)


def _paths(one: Written, view: PackageView) -> Iterator[str]:
    is_open = one.name == "install" and not _INSTALLED.isdisjoint(one.words)
    for before, word in zip(("", *one.words), one.words, strict=False):
        whole = view.cmake.inside(word, one)
        if whole is not None and "*" not in word:
            yield "" if whole in (".", view.folder) else view.inside(whole)
        elif is_open and before != "DESTINATION":
            yield ""


def _covers(named: str, path: str) -> bool:
    return named in ("", path) or path.startswith(f"{named}/") or basename(named) == basename(path)


def _as_note(hit: Hit) -> Hit:
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) if hit.rule in _RULES else hit
