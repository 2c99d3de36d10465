"""Whether what is kept of a workspace was made by this user: a clone must not bring its own clean verdict.

A folder ``.roslens`` that roslens made has a mark that only this user can make, and that is of this folder alone: by
its path, or by its number in the file system where it was moved. So a mark that leaked opens no other folder. One
without it, one that git tracks, a link, or one that belongs to another user is set aside: a store in it could have its
findings deleted.
"""

from __future__ import annotations

import contextlib
import hmac
import os
import stat
import subprocess
from collections.abc import Mapping
from pathlib import Path

from roslens.children.git import git_environment, git_words, looks_bare
from roslens.intake.bounded_file import read_bounded
from roslens.intake.user_folder import user_folder, user_secret, write_private

MARK = "maker"
_KEPT = ("store.sqlite", "changed.sqlite", "cache.sqlite", "history.sqlite")
_GIT_LIMIT_S = 10.0
_SINCE = "marks-of-folders"
_SEALED_SINCE = "sealed-stores"
_WORDS = 3
"""Of a mark: by path, by number in the file system, and the identity of the folder."""


def why_foreign(folder: Path, environment: Mapping[str, str]) -> str:
    """Return why what is kept in ``folder`` may be of someone else; empty if this user made it, or it is not there."""
    try:
        found = folder.lstat()
    except OSError:
        return ""
    return _strange(folder, found) or _tracked(folder) or _unmarked(folder, environment)


def mark_own(folder: Path, environment: Mapping[str, str]) -> None:
    """Mark a folder as made by this user, at the place where it is now.

    Raises:
        OSError: it cannot be written.
    """
    identity, is_current = _identity(folder, environment), False
    if identity:
        is_current = _read_mark(folder) == [*_marks(folder, identity, environment), identity]
    else:
        # Of processes that mark a new folder at once, each makes the same.
        found = folder.stat()
        first = b"a folder of roslens\0%d:%d" % (found.st_dev, found.st_ino)
        identity = hmac.new(user_secret(environment), first, "sha256").hexdigest()[:32].encode()
    if not is_current:
        write_private(folder / MARK, b"\n".join([*_marks(folder, identity, environment), identity]) + b"\n")


def key_of_store(path: Path, environment: Mapping[str, str]) -> bytes:
    """Return the key that a store is sealed with, which opens none of another name, folder or user.

    Raises:
        OSError: the folder cannot be marked, and has no mark yet.
    """
    folder = path.parent
    try:
        mark_own(folder, environment)
    except OSError:
        if not _identity(folder, environment):
            raise
    of = _identity(folder, environment) + b"\0" + os.fsencode(path.name)
    return hmac.digest(user_secret(environment), b"stores of roslens in\0" + of, "sha256")


def lies_here_from_before(path: Path, environment: Mapping[str, str]) -> bool:
    """Return whether a store lay here already before stores of this user were sealed: nobody can set that back."""
    since = user_folder(environment) / _SEALED_SINCE
    try:
        _note_since(since)
        return path.stat().st_ctime_ns <= since.stat().st_mtime_ns
    except OSError:
        return False


def _identity(folder: Path, environment: Mapping[str, str]) -> bytes:
    """Return the identity in the mark of a folder, if it is this folder's; empty for none."""
    given = _read_mark(folder)
    if len(given) != _WORDS:
        return b""
    own = _marks(folder, given[-1], environment)
    return given[-1] if any(map(hmac.compare_digest, given, own)) else b""


def _read_mark(folder: Path) -> list[bytes]:
    try:
        return read_bounded(folder / MARK).split()
    except OSError:
        return []


def _marks(folder: Path, identity: bytes, environment: Mapping[str, str]) -> list[bytes]:
    """Return the marks of a folder with an identity: by its path, and by its number in the file system."""
    found = folder.stat()
    places = (os.fsencode(folder.resolve()), b"%d:%d" % (found.st_dev, found.st_ino))
    of = b"\0" + identity if identity else b""
    secret = user_secret(environment)
    return [hmac.new(secret, b"results of roslens in\0" + one + of, "sha256").hexdigest().encode() for one in places]


def _is_of_earlier_version(folder: Path, content: bytes, environment: Mapping[str, str]) -> bool:
    """Return whether a mark is that of a version whose marks were the same for all folders of a user.

    It is taken only where it lay here before this version came: nobody can set back when a file was made here.
    """
    earlier = hmac.new(user_secret(environment), b"results of roslens", "sha256").hexdigest().encode()
    if not hmac.compare_digest(content, earlier):
        return False
    note_version(environment)
    since = user_folder(environment) / _SINCE
    try:
        return (folder / MARK).stat().st_ctime <= since.stat().st_mtime
    except OSError:
        return False


def note_version(environment: Mapping[str, str]) -> None:
    """Remember when marks of single folders, and seals of stores, began for this user; once."""
    for name in (_SINCE, _SEALED_SINCE):
        with contextlib.suppress(OSError):
            _note_since(user_folder(environment) / name)


def _note_since(since: Path) -> None:
    if not since.exists():
        write_private(since, b"marks are of single folders, and stores are sealed, from when this file was made on\n")


def _strange(folder: Path, found: os.stat_result) -> str:
    if stat.S_ISLNK(found.st_mode):
        return "is a link"
    if not stat.S_ISDIR(found.st_mode):
        return "is not a folder"
    if hasattr(os, "geteuid") and found.st_uid != os.geteuid():
        return f"belongs to another user (number {found.st_uid})"
    for name in (*_KEPT, MARK):
        try:
            kept = (folder / name).lstat()
        except OSError:
            continue
        if not stat.S_ISREG(kept.st_mode):
            return f"has a {name} that is not a regular file"
    return ""


def _tracked(folder: Path) -> str:
    root = str(folder.parent)
    if looks_bare(root):
        return ""
    try:
        done = subprocess.run(
            git_words(root, "ls-files", "-z", "--", folder.name), capture_output=True, timeout=_GIT_LIMIT_S,
            check=False, stdin=subprocess.DEVNULL, env=git_environment(os.environ),
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return "is part of a git repository, so it came with the source" if done.stdout else ""


def _unmarked(folder: Path, environment: Mapping[str, str]) -> str:
    if not any((folder / name).exists() for name in _KEPT):
        return ""
    try:
        content = read_bounded(folder / MARK)
    except OSError:
        return "has no mark of its creator"
    given = content.split()
    # The marks of an earlier version have no identity.
    identity = given[-1] if len(given) == _WORDS else b""
    own = _marks(folder, identity, environment)
    if any(hmac.compare_digest(one, mark) for one, mark in zip(given, own, strict=False)) or _is_of_earlier_version(
        folder, content, environment
    ):
        return ""
    return "was made by another user, or somewhere else"
