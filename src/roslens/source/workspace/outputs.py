"""Which folders are never looked into: those that tools write, and those of version control.

A source folder may be called ``build`` or ``log``; inside a package a folder of such a name is left out only when it
looks like what a build tool wrote. Outside packages the name is enough, unless the folder is a package itself.
"""

from __future__ import annotations

from collections.abc import Set as AbstractSet

IGNORE_MARKERS = frozenset(("CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE"))
"""A file of one of these names hides its folder and all below."""

NEVER = frozenset(("__pycache__", "node_modules", "CMakeFiles", "_CPack_Packages"))

OUTPUT_NAMES = frozenset(
    (
        "build",
        "install",
        "devel",
        "log",
        "logs",
        "build_isolated",
        "install_isolated",
        "devel_isolated",
    )
)

_BUILD_TREE = "CMakeCache.txt"

_SIGNS = frozenset(
    (
        ".built_by",
        ".catkin",
        ".colcon_install_layout",
        ".rosinstall",
        "CMakeFiles",
        "Makefile.cmake",
        "_setup_util.py",
        "build.ninja",
        "latest_build",
        "local_setup.bash",
        "local_setup.sh",
        "setup.bash",
        "setup.sh",
    )
)


def never_entered(name: str) -> bool:
    """Return whether a folder of this name holds no source wherever it is (hidden folders, caches)."""
    return name.startswith(".") or name in NEVER or name.endswith(".egg-info")


def is_output(name: str, entries: AbstractSet[str], *, in_package: bool, beside: AbstractSet[str]) -> bool:
    """Return whether a folder without a manifest is the output of a build.

    Args:
        name: of the folder; empty for the folder that the user gave.
        entries: names of what is in it.
        in_package: whether a folder around it is a package.
        beside: names of what is in the folder around it.
    """
    if not name:
        return False
    if _BUILD_TREE in entries and "CMakeLists.txt" not in entries:
        return True
    if name not in OUTPUT_NAMES:
        return False
    return not in_package or bool(_SIGNS & entries) or _is_python_build(name, entries, beside)


def _is_python_build(name: str, entries: AbstractSet[str], beside: AbstractSet[str]) -> bool:
    written = any(entry == "lib" or entry.startswith(("bdist.", "lib.", "temp.")) for entry in entries)
    return name == "build" and "setup.py" in beside and written
