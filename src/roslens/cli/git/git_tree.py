"""The files of a revision, taken from git into a folder; nothing is checked out, fetched or run."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import IO

import msgspec

from roslens.cli.git.git_repository import Repository, said
from roslens.cli.git.git_submodule import submodule_at
from roslens.model.errors import UsageError
from roslens.source.history.partial_clone import PARTIAL_SETTINGS

LARGEST_BYTES = 2_000_000
"""Larger files are there, but empty: nothing is extracted from recordings, meshes and maps."""

_SYMLINK = "120000"
_SUBMODULE = "160000"


class Lacking(msgspec.Struct, frozen=True):
    """What git does not have of a revision, by paths below the folder that is looked at.

    Attributes:
        files: they are there, but empty.
        submodules: nothing of them is there; each with the commit that is missing.
    """

    files: tuple[str, ...] = ()
    submodules: tuple[tuple[str, str], ...] = ()


class _Entry(msgspec.Struct, frozen=True):
    mode: str
    hash: str
    path: str


def write_tree(
    repository: Repository, commit: str, folder: Path, only: Callable[[str], bool] = lambda _: True
) -> Lacking:
    """Write the files of a commit below ``folder``, those of the repository's part that is looked at.

    What is large is there, but empty. Submodules are written too, as far as their commits are on this machine. ``only``
    says of the path of a file whether it is wanted.

    Raises:
        UsageError: git does not have the lists of files.
    """
    found = [one for one in _entries(repository, commit) if one.mode == _SUBMODULE or only(one.path)]
    plain = [entry for entry in found if entry.mode not in (_SYMLINK, _SUBMODULE)]
    links = [entry for entry in found if entry.mode == _SYMLINK]
    missing = []
    for entry, content in _contents(repository, commit, plain):
        place = folder / entry.path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content or b"")
        if content is None:
            missing.append(entry.path)
    lacking = Lacking(tuple(missing))
    for entry in found:
        if entry.mode == _SUBMODULE:
            lacking = _joined(lacking, entry, _write_submodule(repository, commit, entry, folder, only))
    # Links come last, so that nothing is written through one.
    for entry, content in _contents(repository, commit, links):
        _link(folder, folder / entry.path, os.fsdecode(content or b""))
    return lacking


def _write_submodule(
    repository: Repository, commit: str, entry: _Entry, folder: Path, only: Callable[[str], bool]
) -> Lacking | None:
    """Write a submodule; None where git does not have it."""
    inner = submodule_at(repository, commit, repository.below + entry.path, entry.hash)
    if inner is None:
        return None
    try:
        return write_tree(inner, entry.hash, folder / entry.path, only)
    except UsageError:
        return None


def _joined(lacking: Lacking, entry: _Entry, inner: Lacking | None) -> Lacking:
    if inner is None:
        return Lacking(lacking.files, (*lacking.submodules, (entry.path, entry.hash)))
    return Lacking(
        (*lacking.files, *(f"{entry.path}/{path}" for path in inner.files)),
        (*lacking.submodules, *((f"{entry.path}/{path}", commit) for path, commit in inner.submodules)),
    )


def _link(folder: Path, place: Path, target: str) -> None:
    inside = os.path.normpath(place.parent / target)
    if target and not target.startswith("/") and Path(inside).is_relative_to(folder) and not os.path.lexists(place):
        place.parent.mkdir(parents=True, exist_ok=True)
        place.symlink_to(target)


def _entries(repository: Repository, commit: str) -> Iterator[_Entry]:
    done = repository.git("ls-tree", "-r", "-z", "--full-tree", commit, "--", repository.below or ".")
    if done.returncode:
        raise _incomplete(commit, said(done))
    for line in done.stdout.split(b"\0"):
        facts, _, path = line.partition(b"\t")
        if path:
            mode, _, name = facts.decode("ascii").split()
            below = os.fsdecode(path)[len(repository.below) :]
            if not {"", ".", "..", ".git"}.intersection(below.split("/")):
                yield _Entry(mode, name, below)


def _contents(repository: Repository, commit: str, entries: Sequence[_Entry]) -> Iterator[tuple[_Entry, bytes | None]]:
    """Yield the content of each, None where git does not have it."""
    if not entries:
        return
    with tempfile.TemporaryFile() as asked, tempfile.TemporaryFile() as reported:
        asked.write("".join(f"{entry.hash}\n" for entry in entries).encode())
        asked.seek(0)
        command, environment = repository.command("cat-file", "--batch"), repository.environment()
        with subprocess.Popen(
            command, stdin=asked, stdout=subprocess.PIPE, stderr=reported, env=environment
        ) as process:
            assert process.stdout is not None  # noqa: S101 - a pipe was asked for
            for entry in entries:
                head = process.stdout.readline().split()
                if not head:
                    process.wait()
                    reported.seek(0)
                    raise _incomplete(commit, reported.read().decode("utf-8", "replace").strip())
                # Git before 2.45 ends at what a partial clone leaves out, later versions go on without it.
                if len(head) != 3 and repository.git("config", "--get-regexp", PARTIAL_SETTINGS).stdout:
                    raise _incomplete(commit, f'"{entry.path}" ({entry.hash[:12]}) is not in this partial clone')
                yield entry, _content(process.stdout, int(head[2])) if len(head) == 3 else None


def _content(stream: IO[bytes], size: int) -> bytes:
    if size <= LARGEST_BYTES:
        return stream.read(size + 1)[:-1]
    left = size + 1
    while left and (part := stream.read(min(left, LARGEST_BYTES))):
        left -= len(part)
    return b""


def _incomplete(commit: str, words: str) -> UsageError:
    return UsageError(
        f'git cannot give the files of revision "{commit[:12]}": {words}',
        expected="a repository that has them",
        advice="In a partial clone, check the revision out once, so that git fetches them",
    )
