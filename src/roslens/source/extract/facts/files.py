"""What evaluation may read: files of packages of the workspace, by name of the package and path. Nothing else."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

from roslens.intake.bounded_file import read_bounded

MOST_LISTED = 5_000


class Files(Protocol):
    """The files of a workspace; paths are relative to its root, with ``/``."""

    def package(self, name: str) -> str | None:
        """Return the folder of a package; None where the workspace has none of that name."""

    def content(self, path: str) -> bytes | None:
        """Return the bytes of a file; None where there is none, or it cannot be read."""

    def listing(self, folder: str) -> tuple[str, ...]:
        """Return the paths of the files below a folder, those in folders of it too; none where there is no folder."""


def joined(folder: str, path: str) -> str:
    """Return a path below a folder without ``.``, ``..`` and double separators; ``..`` leads out."""
    pieces: list[str] = []
    for piece in f"{folder}/{path}".split("/"):
        if piece == ".." and pieces and pieces[-1] != "..":
            pieces.pop()
        elif piece not in ("", "."):
            pieces.append(piece)
    return "/".join(pieces)


class FolderFiles:
    """The files below a folder; nothing outside of it is read, not even through links."""

    def __init__(self, root: Path, packages: Mapping[str, str], most_bytes: int = 2_000_000) -> None:
        """Read below ``root``.

        Args:
            root: of the workspace.
            packages: folders of packages below it, by name.
            most_bytes: larger files are as if they were not there.
        """
        self._root = root.resolve()
        self._packages = dict(packages)
        self._most_bytes = most_bytes

    def package(self, name: str) -> str | None:
        """Return the folder of a package; None where the workspace has none of that name."""
        return self._packages.get(name)

    def content(self, path: str) -> bytes | None:
        """Return the bytes of a file; None where there is none, or it cannot be read."""
        try:
            found = (self._root / path).resolve()
            return read_bounded(found, self._most_bytes) if found.is_relative_to(self._root) else None
        except (OSError, ValueError, RuntimeError):
            return None

    def listing(self, folder: str) -> tuple[str, ...]:
        """Return the paths of the files below a folder, those in folders of it too; none where there is no folder.

        Of a folder with more than :data:`MOST_LISTED` files none are returned: a part of them would be taken for all.
        """
        found: list[str] = []
        try:
            top = (self._root / folder).resolve()
            for here, folders, names in os.walk(top) if top.is_relative_to(self._root) else ():
                folders[:] = sorted(one for one in folders if not one.startswith("."))
                found += [(Path(here) / name).relative_to(self._root).as_posix() for name in names]
                if len(found) > MOST_LISTED:
                    return ()
        except (OSError, ValueError, RuntimeError):
            return ()
        return tuple(sorted(found))


def folders_in_common(one: str, other: str) -> int:
    """Return how many folders two paths have in common."""
    count = 0
    for left, right in zip(one.split("/")[:-1], other.split("/")[:-1], strict=False):
        if left != right:
            break
        count += 1
    return count
