"""One walk over the folders of a workspace: no file is opened, each folder is listed once.

Links are followed after everything real was walked, once for each real folder, and never to a folder around the
given ones: a workspace is not widened by a link.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from operator import attrgetter
from pathlib import Path
from posixpath import basename, dirname
from stat import S_ISREG

import msgspec

from roslens.intake.is_there import is_folder
from roslens.model.failure import Failure
from roslens.model.source import Language, Location
from roslens.source.workspace.languages import language_by_name
from roslens.source.workspace.manifest import MANIFEST_NAME
from roslens.source.workspace.outputs import IGNORE_MARKERS, is_output, never_entered


class FoundFile(msgspec.Struct, frozen=True, gc=False):
    """A file: ``path`` below the workspace root with ``/``, ``size`` in bytes, ``mtime_ns`` since the epoch."""

    path: str
    size: int
    mtime_ns: int
    inode: int


class PackageFolder(msgspec.Struct):
    """A folder with a manifest (or, for the first of a walk, what is in none): ``path`` below the root, or empty."""

    path: str
    folder: str
    files: list[FoundFile]


class Walked(msgspec.Struct):
    """What a walk saw: ``packages[0]`` takes the files outside packages.

    ``repositories`` are the folders that hold ``.git``; ``hidden`` maps folders that a marker hides to its name.
    """

    packages: list[PackageFolder]
    repositories: set[str]
    hidden: dict[str, str]
    failures: list[Failure]


_name: Callable[[os.DirEntry[str]], str] = attrgetter("name")


class _Visit(msgspec.Struct, gc=False):
    """A folder to list: where it is, below the root, in which package, and what is beside it."""

    folder: str
    path: str
    owner: int
    beside: frozenset[str]


def walk(root: str, starts: Sequence[str], ignore: re.Pattern[str] | None) -> Walked:
    """Walk ``starts`` (absolute, resolved, none inside another one), which are ``root`` or below it."""
    walker = _Walker(root, starts, ignore)
    for start in starts:
        path = "" if start == root else os.path.relpath(start, root).replace(os.sep, "/")
        walker.follow(_Visit(start, path, 0, frozenset()), named=False)
    walker.follow_links()
    return walker.seen


class _Walker:
    def __init__(self, root: str, starts: Sequence[str], ignore: re.Pattern[str] | None) -> None:
        self.seen = Walked([PackageFolder("", root, [])], set(), {}, [])
        self._starts = starts
        self._ignore = ignore
        self._visited: set[str] = set()
        self._links: list[tuple[str, str, int, frozenset[str]]] = []

    def follow(self, first: _Visit, *, named: bool) -> None:
        """Walk a folder and all below; ``named`` is whether its own name may make it an output."""
        pending = [first]
        while pending:
            visit = pending.pop()
            if visit.folder not in self._visited:
                self._visited.add(visit.folder)
                pending.extend(self._list(visit, named=named or visit is not first))

    def follow_links(self) -> None:
        """Follow the links met so far and those met on the way, in the order of their paths."""
        real_files: set[str] = set()
        while self._links:
            links, self._links = sorted(self._links), []
            for path, absolute, owner, beside in links:
                target = os.path.realpath(absolute)
                if is_folder(target):
                    if not any(start == target or start.startswith(target.rstrip("/") + "/") for start in self._starts):
                        self.follow(_Visit(target, path, owner, beside), named=True)
                    continue
                real_files = real_files or self._real_files()
                self._link_to_file(path, absolute, target, owner, real_files)

    def _list(self, visit: _Visit, *, named: bool) -> list[_Visit]:
        try:
            with os.scandir(visit.folder) as listing:
                entries = sorted(listing, key=_name)
        except OSError as error:
            self._fail(visit.path or ".", f"the folder cannot be read, {error.strerror}", "a folder that can be read")
            return []
        names = frozenset(map(_name, entries))
        if marker := IGNORE_MARKERS & names:
            self.seen.hidden[visit.path or "."] = min(marker)
            return []
        if MANIFEST_NAME in names and Path(visit.folder, MANIFEST_NAME).is_file():
            visit.owner = len(self.seen.packages)
            self.seen.packages.append(PackageFolder(visit.path, visit.folder, []))
        elif is_output(basename(visit.path) if named else "", names, in_package=visit.owner > 0, beside=visit.beside):
            return []
        if ".git" in names:
            self.seen.repositories.add(visit.path)
        return self._sort_out(visit, entries, names)

    def _sort_out(self, visit: _Visit, entries: list[os.DirEntry[str]], names: frozenset[str]) -> list[_Visit]:
        files = self.seen.packages[visit.owner].files
        folders: list[_Visit] = []
        for entry, path in self._looked_at(visit, entries):
            name = entry.name
            if entry.is_file(follow_symlinks=False):
                self._take_file(entry, path, files)
            elif entry.is_symlink():
                if not never_entered(name):
                    self._links.append((path, f"{visit.folder}/{name}", visit.owner, names))
            elif entry.is_dir(follow_symlinks=False):
                if not never_entered(name):
                    folders.append(_Visit(f"{visit.folder}/{name}", path, visit.owner, names))
            else:
                self._skip(path)
        folders.reverse()
        return folders

    def _looked_at(self, visit: _Visit, entries: Iterable[os.DirEntry[str]]) -> Iterator[tuple[os.DirEntry[str], str]]:
        """Yield the entries of a folder that are neither hidden nor left out, with their paths."""
        prefix = f"{visit.path}/" if visit.path else ""
        for entry in entries:
            name = entry.name
            path = prefix + name
            if name[0] == "." or (self._ignore and self._ignore.fullmatch(path)):
                continue
            if name.isascii() or self._readable_name(prefix, name):
                yield entry, path

    def _take_file(self, entry: os.DirEntry[str], path: str, files: list[FoundFile]) -> None:
        try:
            stat = entry.stat(follow_symlinks=False)
        except OSError as error:
            self._fail(path, f"the file cannot be looked at, {error.strerror}", "a file that can be read")
            return
        files.append(FoundFile(path, stat.st_size, stat.st_mtime_ns, stat.st_ino))

    def _link_to_file(self, path: str, absolute: str, target: str, owner: int, real_files: set[str]) -> None:
        if target in real_files and basename(path) != MANIFEST_NAME:
            return
        try:
            stat = Path(absolute).stat()
        except OSError as error:
            if language_by_name(path) not in (None, Language.OTHER):
                what = f'the link to "{_shown(os.fspath(Path(absolute).readlink()))}" leads nowhere, {error.strerror}'
                self._fail(path, what, "a link to a file that exists")
            return
        if S_ISREG(stat.st_mode):
            real_files.add(target)
            self.seen.packages[owner].files.append(FoundFile(path, stat.st_size, stat.st_mtime_ns, stat.st_ino))
        else:
            self._skip(path)

    def _skip(self, path: str) -> None:
        """Report a pipe, a socket or a device with the name of a source file; others are not analysed anyway."""
        if language_by_name(path) not in (None, Language.OTHER):
            self._fail(path, "it is a pipe, a socket or a device", "a plain file")

    def _real_files(self) -> set[str]:
        root = self.seen.packages[0].folder
        return {f"{root}/{file.path}" for package in self.seen.packages for file in package.files}

    def _readable_name(self, prefix: str, name: str) -> bool:
        try:
            name.encode()
        except UnicodeEncodeError:
            where = _shown(prefix) + _shown(name)
            self._fail(where, f'the name "{_shown(name)}" is not UTF-8', "names in UTF-8", "Rename it.")
            return False
        return True

    def _fail(self, path: str, what: str, expected: str, advice: str = "") -> None:
        advice = advice or "Correct it, or add it to `ignore` below [workspace] in roslens.toml."
        self.seen.failures.append(Failure("workspace", what, expected, advice, Location(path)))


def repository_of(path: str, repositories: set[str], root: str) -> str:
    """Return the name of the repository of the package at ``path`` (empty for the root).

    It is the nearest folder, from the package up to the root, that holds ``.git``; without one the first folder
    below the root (``src`` is passed over) that is not the package itself; else an empty text.
    """
    folder = path
    while True:
        if folder in repositories:
            return basename(folder) or basename(root)
        if not folder:
            break
        folder = dirname(folder)
    parts = path.split("/")
    while parts and parts[0] == "src":
        del parts[0]
    return parts[0] if len(parts) > 1 else ""


def _shown(name: str) -> str:
    return os.fsencode(name).decode("utf-8", "backslashreplace")
