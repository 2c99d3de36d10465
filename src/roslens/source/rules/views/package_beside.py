"""Whether a package of the workspace has a file that a launch file names, or may have it once it is built."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path

from roslens.intake.bounded_file import read_bounded

MOST_ENTRIES = 20_000
"""Files of a package that are looked at; of one with more it is not known what it has."""
_LEFT_OUT = frozenset({".git", "build", "install", "log", "devel", "node_modules", ".roslens"})
_BUILDS = ("CMakeLists.txt", "setup.py", "setup.cfg")
_MADE = re.compile(
    r"configure_file\([^)]*\$\{(?!CMAKE_|PROJECT_)|add_custom_command|add_custom_target|BINARY_DIR|ExternalProject"
    r"|FetchContent"
)
_MOST_BYTES = 1_000_000


class PackageBeside:
    """A package by its folder; only what is asked for is read."""

    def __init__(self, root: str, folder: str) -> None:
        """Take the root of the workspace, and the folder of the package below it."""
        self._folder = Path(root, folder)

    def may_have(self, inside: str) -> bool:
        """Return whether a path below the package leads to something, or may once it is built and installed."""
        if (self._folder / inside).exists() or self._is_in_submodule(inside):
            return True
        name = inside.rpartition("/")[2]
        names = self._names
        if names is None or name in names or not name:
            return True
        return bool({f"{name}.in", f"{name}.xacro", f"{name}.em", f"{name}.j2"} & names) or name in self._builds

    @cached_property
    def is_for_ros2(self) -> bool:
        """Whether it is built for ROS 2."""
        return "ament" in self._read("package.xml")

    def like(self, inside: str) -> str:
        """Return the name of a file of the package that is nearly the one that is missing; empty where none is."""
        from difflib import get_close_matches

        near = get_close_matches(inside.rpartition("/")[2], sorted(self._names or ()), 1, 0.75)
        return near[0] if near else ""

    @cached_property
    def _names(self) -> frozenset[str] | None:
        found: set[str] = set()
        for number, name in enumerate(self._walk()):
            if number >= MOST_ENTRIES:
                return None
            found.add(name)
        return frozenset(found)

    def _walk(self) -> Iterator[str]:
        for _, folders, files in os.walk(self._folder):
            folders[:] = [one for one in folders if one not in _LEFT_OUT]
            yield from files

    @cached_property
    def _builds(self) -> str:
        """The text of what builds and installs it."""
        return "\n".join(self._read(name) for name in _BUILDS)

    def installs_what_it_makes(self, inside: str) -> bool:
        """Return whether its build makes files of such a kind, or installs a folder that is not here."""
        text = self._read("CMakeLists.txt")
        suffix = inside.rpartition(".")[2]
        return _MADE.search(text) is not None and (f".{suffix}" in text or "BINARY_DIR" in text)

    def _is_in_submodule(self, inside: str) -> bool:
        """Return whether a path lies in an empty folder, as those of submodules that were not fetched are."""
        folder = (self._folder / inside).parent
        while folder != self._folder and self._folder in folder.parents:
            if folder.is_dir():
                return not any(folder.iterdir())
            folder = folder.parent
        return False

    def _read(self, name: str) -> str:
        try:
            return read_bounded(self._folder / name, _MOST_BYTES).decode("utf-8", "replace")
        except (OSError, ValueError):
            return ""
