"""The files of a revision, taken from git into a folder; nothing is checked out, fetched or run."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO

import msgspec

from roslens.model.errors import UsageError

LARGEST_BYTES = 2_000_000
"""Larger files are there, but empty: nothing is extracted from recordings, meshes and maps."""

_SYMLINK = "120000"
_SUBMODULE = "160000"
# A repository may configure programs that a look at it must not start, and a part of it may still be on a server.
_QUIETLY = ("-c", "core.fsmonitor=false", "-c", "core.hooksPath=/dev/null", "-c", "protocol.allow=never")


class Repository(msgspec.Struct, frozen=True):
    """A git repository and the folder in it that is looked at: ``below`` its root, empty or ending with ``/``."""

    root: str
    below: str


class _Entry(msgspec.Struct, frozen=True):
    mode: str
    hash: str
    path: str


def repository_of(path: str) -> Repository:
    """Return the repository that a folder is in.

    Raises:
        UsageError: it is in none, or git cannot be run.
    """
    done = _git(path, "rev-parse", "--show-toplevel", "--show-prefix")
    if done.returncode:
        raise UsageError(
            f'"{path}" is in no git repository that can be read: {_said(done)}',
            expected="revisions of one",
            advice="Give the folder of a repository as PATH",
        )
    root, _, below = os.fsdecode(done.stdout).partition("\n")
    return Repository(root, below.strip("\n"))


def commit_of_revision(repository: Repository, name: str) -> str:
    """Return the commit that a revision means; empty where there is none of that name."""
    done = _git(repository.root, "rev-parse", "--verify", "--quiet", "--end-of-options", f"{name}^{{commit}}")
    return done.stdout.decode("ascii", "replace").strip() if not done.returncode else ""


def names_like(repository: Repository, name: str) -> list[str]:
    """Return branches and tags whose names are like this one, the best first."""
    import difflib

    done = _git(repository.root, "for-each-ref", "--format=%(refname:short)")
    return difflib.get_close_matches(name, ["HEAD", *os.fsdecode(done.stdout).split()], 3, 0.5)


def write_tree(repository: Repository, commit: str, folder: Path) -> tuple[str, ...]:
    """Write the files of a commit below ``folder``, those of the repository's part that is looked at.

    What is large is there, but empty; what is in submodules is not there. Returns the paths of files that git lacks;
    they are empty too.

    Raises:
        UsageError: git does not have all of them.
    """
    found = list(_entries(repository, commit))
    plain = [entry for entry in found if entry.mode not in (_SYMLINK, _SUBMODULE)]
    links = [entry for entry in found if entry.mode == _SYMLINK]
    missing = []
    for entry, content in _contents(repository, commit, plain):
        place = folder / entry.path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content or b"")
        if content is None:
            missing.append(entry.path)
    # Links come last, so that nothing is written through one.
    for entry, content in _contents(repository, commit, links):
        _link(folder, folder / entry.path, os.fsdecode(content or b""))
    return tuple(missing)


def _link(folder: Path, place: Path, target: str) -> None:
    inside = os.path.normpath(place.parent / target)
    if target and not target.startswith("/") and Path(inside).is_relative_to(folder) and not place.exists():
        place.parent.mkdir(parents=True, exist_ok=True)
        place.symlink_to(target)


def _entries(repository: Repository, commit: str) -> Iterator[_Entry]:
    done = _git(repository.root, "ls-tree", "-r", "-z", "--full-tree", commit, "--", repository.below or ".")
    if done.returncode:
        raise _incomplete(commit, _said(done))
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
    with tempfile.TemporaryFile() as asked, tempfile.TemporaryFile() as told:
        asked.write("".join(f"{entry.hash}\n" for entry in entries).encode())
        asked.seek(0)
        command = ["git", *_QUIETLY, "-C", repository.root, "cat-file", "--batch"]
        with subprocess.Popen(command, stdin=asked, stdout=subprocess.PIPE, stderr=told, env=_environment()) as process:
            assert process.stdout is not None  # noqa: S101 - a pipe was asked for
            for entry in entries:
                head = process.stdout.readline().split()
                if not head:
                    process.wait()
                    told.seek(0)
                    raise _incomplete(commit, told.read().decode("utf-8", "replace").strip())
                yield entry, _content(process.stdout, int(head[2])) if len(head) == 3 else None


def _content(stream: IO[bytes], size: int) -> bytes:
    if size <= LARGEST_BYTES:
        return stream.read(size + 1)[:-1]
    left = size + 1
    while left and (part := stream.read(min(left, LARGEST_BYTES))):
        left -= len(part)
    return b""


def _incomplete(commit: str, said: str) -> UsageError:
    return UsageError(
        f'git cannot give the files of revision "{commit[:12]}": {said}',
        expected="a repository that has them",
        advice="In a partial clone, check the revision out once, so that git fetches them",
    )


def _git(folder: str, *arguments: str) -> subprocess.CompletedProcess[bytes]:
    command = ["git", *_QUIETLY, "-C", folder, *arguments]
    try:
        return subprocess.run(command, capture_output=True, timeout=60, check=False, env=_environment())
    except FileNotFoundError as error:
        raise UsageError("git is not installed", expected="git, to read revisions", advice="Install git") from error
    except subprocess.TimeoutExpired as error:
        raise UsageError(
            f"git did not answer in {error.timeout:g} s", expected="a repository that can be read"
        ) from error


def _environment() -> dict[str, str]:
    return {**os.environ, "GIT_TERMINAL_PROMPT": "0", "GIT_NO_LAZY_FETCH": "1", "LC_ALL": "C"}


def _said(done: subprocess.CompletedProcess[bytes]) -> str:
    return " ".join(done.stderr.decode("utf-8", "replace").split()) or "git says nothing"
