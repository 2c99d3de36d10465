"""What the CMake files of a package download and build themselves, so that no manifest has to declare it."""

from __future__ import annotations

from collections.abc import Set

from roslens.source.rules.views.cmake_view import CmakeView

_DOWNLOADING = frozenset({
    "fetchcontent_declare", "fetchcontent_populate", "fetchcontent_makeavailable", "externalproject_add",
    "ament_vendor", "cpmaddpackage", "cpmfindpackage",
})  # fmt: skip
_NAMED = "NAME"
"""What stands before the name of a package for CPM."""


def downloaded(cmake: CmakeView) -> Set[str]:
    """Return the names of the projects that commands download, in lower case: CMake does not tell cases apart."""
    found: set[str] = set()
    for one in cmake.named(*_DOWNLOADING):
        words = one.words[one.words.index(_NAMED) + 1 :] if _NAMED in one.words else one.words
        found.update(word.lower() for word in (words if one.name == "fetchcontent_makeavailable" else words[:1]))
    return found
