"""Which files of a workspace were saved, came or went since they were last looked at, by their time stamps."""

from __future__ import annotations

import os
from collections.abc import Collection
from pathlib import Path

import msgspec

from roslens.model.source import Language
from roslens.source.workspace.languages import language_by_name

Stamp = tuple[int, int, int]


class Saved(msgspec.Struct, frozen=True):
    """Paths that were saved, sorted, and whether files came or went: then packages are to be looked for again."""

    paths: tuple[str, ...] = ()
    other_files: bool = False


class SavedFiles:
    """The files of a workspace and the folders that they are in, as they were when they were last asked about."""

    def __init__(self, root: Path, files: Collection[str]) -> None:
        """``files`` are below ``root``; none of them is opened."""
        self._root = str(root)
        self.know(files)

    def know(self, files: Collection[str]) -> None:
        """Take these files as they are now for those that there are."""
        self._files = {path: self._stamp(path) for path in files}
        folders = {path.rpartition("/")[0] for path in files}
        self._folders = {folder: self._stamp(folder) for folder in folders}
        self._names = {folder: self._listed(folder) for folder in folders}

    def poll(self) -> Saved:
        """Return what happened since the last time."""
        saved = []
        for path, before in self._files.items():
            now = self._stamp(path)
            if now != before:
                self._files[path] = now
                if now is not None:
                    saved.append(path)
        gone = any(stamp is None for stamp in self._files.values())
        return Saved(tuple(sorted(saved)), self._came() or gone)

    def _came(self) -> bool:
        """Whether a folder has other files that are looked at; one that takes the place of another is the same file."""
        came = False
        for folder, before in self._folders.items():
            now = self._stamp(folder)
            if now != before:
                self._folders[folder] = now
                names = self._listed(folder)
                came = came or names != self._names[folder]
                self._names[folder] = names
        return came

    def _listed(self, folder: str) -> frozenset[str]:
        try:
            names = [entry.name for entry in os.scandir(f"{self._root}/{folder}")]
        except OSError:
            return frozenset()
        return frozenset(name for name in names if language_by_name(name) not in {None, Language.OTHER})

    def _stamp(self, path: str) -> Stamp | None:
        try:
            stat = os.stat(f"{self._root}/{path}")  # noqa: PTH116 - thousands, ten times a second
        except OSError:
            return None
        return stat.st_mtime_ns, stat.st_size, stat.st_ino
