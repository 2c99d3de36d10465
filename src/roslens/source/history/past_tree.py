"""The files of one past revision after the other, in a folder of our own: only what differs is written."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import IO

import msgspec

from roslens.children.git import git_environment, git_words
from roslens.intake.bounded_file import MOST_SOURCE_BYTES
from roslens.model.source import Language
from roslens.source.history.git_answer import HistoryError, git_answer
from roslens.source.history.partial_clone import is_partial
from roslens.source.workspace.languages import language_by_name

LARGEST_OTHER_BYTES = 1 << 16
"""Of a larger file without a language, a mesh for instance, only whether it is there is of interest."""

_SYMLINK = "120000"
_SUBMODULE = "160000"
_NEVER = {"", ".", "..", ".git", ".roslens"}


class Entry(msgspec.Struct, frozen=True):
    """A file as git has it: mode, hash and path below the folder that is looked at."""

    mode: str
    hash: str
    path: str


class PastTree:
    """A folder that holds the files of one revision at a time; a context manager.

    Attributes:
        folder: where they are.
        lacking: files of the revision that git does not have.
        submodules: folders of the revision that other repositories have.
    """

    def __init__(self, top: str, below: str, folder: Path) -> None:
        """Take what says where.

        Args:
            top: folder of the work tree of the repository.
            below: the folder in it that is looked at; empty or ending with ``/``.
            folder: an empty one of our own.
        """
        self.folder = folder
        self.lacking: tuple[str, ...] = ()
        self.submodules: tuple[str, ...] = ()
        self._top = top
        self._below = below
        self._there: dict[str, Entry] = {}
        self._process: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> PastTree:
        """Return the tree itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End git."""
        if self._process is not None:
            for stream in (self._process.stdin, self._process.stdout):
                if stream is not None:
                    with suppress(OSError):
                        stream.close()
            self._process.kill()
            self._process.wait()
            self._process = None

    def show(self, commit: str) -> list[str]:
        """Make the folder hold the files of a commit, none of an empty one; return the paths written or removed.

        Raises:
            HistoryError: git does not have the list of files.
        """
        wanted = {entry.path: entry for entry in _entries(self._top, self._below, commit)} if commit else {}
        self.submodules = tuple(path for path, entry in wanted.items() if entry.mode == _SUBMODULE)
        wanted = {path: entry for path, entry in wanted.items() if entry.mode != _SUBMODULE}
        gone = [path for path in self._there if wanted.get(path) != self._there[path]]
        new = [entry for path, entry in wanted.items() if self._there.get(path) != entry]
        for path in gone:
            self._remove(path)
        # Links come last, so that nothing is written through one.
        new.sort(key=lambda entry: entry.mode == _SYMLINK)
        missing = [entry.path for entry in new if not self._write(entry)]
        self.lacking = tuple(missing)
        self._there = {path: entry for path, entry in wanted.items() if path not in set(missing)}
        return [*gone, *(entry.path for entry in new)]

    def _remove(self, path: str) -> None:
        place = self.folder / path
        place.unlink(missing_ok=True)
        for above in place.parents:
            if above == self.folder:
                break
            try:
                above.rmdir()
            except OSError:
                break

    def _write(self, entry: Entry) -> bool:
        content = self._content(entry)
        if content is None:
            return False
        place = self.folder / entry.path
        place.parent.mkdir(parents=True, exist_ok=True)
        if entry.mode == _SYMLINK:
            self._link(place, os.fsdecode(content))
        else:
            place.write_bytes(content)
        return True

    def _link(self, place: Path, target: str) -> None:
        inside = os.path.normpath(place.parent / target)
        if target and not target.startswith("/") and Path(inside).is_relative_to(self.folder):
            with suppress(OSError):
                place.symlink_to(target)

    def _content(self, entry: Entry) -> bytes | None:
        stdin, stdout = self._pipes()
        try:
            stdin.write(f"{entry.hash}\n".encode())
            stdin.flush()
            head = stdout.readline().split()
        except OSError as error:
            raise HistoryError(f"git ended while it gave files: {error}") from error
        if not head:
            raise HistoryError("git ended while it gave files")
        if len(head) != 3:
            # Git before 2.45 ends here, later versions go on without what a partial clone leaves out.
            if is_partial(self._top):
                raise HistoryError(f'"{entry.path}" ({entry.hash[:12]}) is not in this partial clone')
            return None
        size = int(head[2])
        most = LARGEST_OTHER_BYTES if language_by_name(entry.path) is Language.OTHER else MOST_SOURCE_BYTES
        if size <= most:
            return stdout.read(size + 1)[:-1]
        left = size + 1
        while left and (part := stdout.read(min(left, 1 << 20))):
            left -= len(part)
        return b""

    def _pipes(self) -> tuple[IO[bytes], IO[bytes]]:
        if self._process is None:
            try:
                self._process = subprocess.Popen(
                    git_words(self._top, "cat-file", "--batch"), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                    stderr=subprocess.DEVNULL, env=git_environment(os.environ),
                )  # fmt: skip
            except OSError as error:
                raise HistoryError(f"git cannot be started: {error}") from error
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None  # noqa: S101 - a pipe was asked for
        assert stdout is not None  # noqa: S101 - a pipe was asked for
        return stdin, stdout


def _entries(top: str, below: str, commit: str) -> Iterator[Entry]:
    answer = git_answer(top, "ls-tree", "-r", "-z", "--full-tree", commit, "--", below or ".")
    for line in answer.split(b"\0"):
        facts, _, path = line.partition(b"\t")
        if path:
            mode, _, name = facts.decode("ascii").split()
            inside = os.fsdecode(path)[len(below) :]
            if not _NEVER.intersection(inside.split("/")):
                yield Entry(mode, name, inside)
