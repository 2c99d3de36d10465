"""What CMake files find around them: variables that packages which are not read may set, and folders."""

from __future__ import annotations

from collections.abc import Iterable
from posixpath import dirname

_FOREIGN_ENDS = ("_FOUND", "_LIBRARIES", "_LIBRARY", "_INCLUDE_DIRS", "_INCLUDE_DIR", "_VERSION", "_DIR", "_EXECUTABLE")
NOT_ON_LINUX = frozenset(
    {"WIN32", "APPLE", "MSVC", "ANDROID", "IOS", "MINGW", "CYGWIN", "BORLAND", "QNX", "QNXNTO", "MSYS", "XCODE", "BSD",
     "MSVC_VERSION", "CMAKE_HOST_WIN32", "CMAKE_HOST_APPLE", "CMAKE_CROSSCOMPILING", "EMSCRIPTEN", "WATCOM"}
)  # fmt: skip
"""Variables that are not set on Linux."""


def may_be_foreign(name: str, foreign: set[str], prefixes: set[str]) -> bool:
    """Return whether a variable may be set by what is not evaluated.

    Args:
        name: of the variable.
        foreign: variables that were given to what is not evaluated.
        prefixes: how the variables begin that packages set which were looked for.
    """
    if name in NOT_ON_LINUX:
        return False
    return (
        name in foreign
        or name.startswith("CMAKE_")
        or name.endswith(_FOREIGN_ENDS)
        or name.partition("_")[0] in prefixes
        or any(name.startswith(f"{prefix}_") for prefix in prefixes if "_" in prefix)
    )


def folders_of(listing: Iterable[str]) -> frozenset[str]:
    """Return the folders that files are in."""
    found: set[str] = set()
    for path in listing:
        folder = dirname(path)
        while folder and folder not in found:
            found.add(folder)
            folder = dirname(folder)
    return frozenset(found)
