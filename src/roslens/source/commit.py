"""Which commit a folder is at, of when it is, and whether what was read differs from it."""

from __future__ import annotations

import hashlib
import os
import subprocess
from collections.abc import Iterable

from roslens.children.git import git_environment, git_words, looks_bare
from roslens.intake.bounded_file import read_bounded
from roslens.model.source import SourceFile

_LIMIT_S = 20.0
_MOST_COMMITS = 10_000


def commit_of(root: str, files: Iterable[SourceFile] = ()) -> str:
    """Return the commit id of the repository that ``root`` is in, with ``+`` where what was read differs from it.

    Empty where there is no repository, no commit or no git. Compared are the contents of ``files``, whose hashes are
    git's, with those of the commit: ``git status`` would run what the repository configures as filters, and write.
    """
    if looks_bare(root):
        return ""
    head = _git(root, "rev-parse", "--verify", "--quiet", "HEAD^{commit}").decode("ascii", "replace").strip()
    if not head:
        return ""
    tracked = _tracked(root)
    differs = any(_differs(root, path, wanted) for path, wanted in _pairs(files, tracked)) or any(
        not os.path.lexists(os.path.join(root, path))  # noqa: PTH118 - thousands of times
        for path in tracked
    )
    return f"{head}+" if differs else head


def last_change_of(root: str) -> str:
    """Return year and month of the last commit that changed anything in the folder, ``2026-03``; else nothing."""
    if looks_bare(root):
        return ""
    said = _git(root, "log", "-1", "--format=%cd", "--date=format:%Y-%m", "--", ".")
    return said.decode("ascii", "replace").strip()


def committers_of(root: str) -> frozenset[str]:
    """Return names and addresses of those who wrote commits, in lower case; none where the past is not all there."""
    shallow = _git(root, "rev-parse", "--is-shallow-repository").strip() if not looks_bare(root) else b"true"
    if shallow != b"false":
        return frozenset()
    said = _git(root, "log", f"-{_MOST_COMMITS}", "--format=%an%n%ae").decode("utf-8", "replace")
    return frozenset(line.strip().lower() for line in said.splitlines()) - {""}


def _tracked(root: str) -> dict[str, str]:
    """Return the hash of each file of the commit by its path below ``root``."""
    found: dict[str, str] = {}
    for line in _git(root, "ls-tree", "-r", "-z", "HEAD").split(b"\0"):
        facts, _, path = line.partition(b"\t")
        if path and facts.split()[1] == b"blob":
            found[os.fsdecode(path)] = facts.split()[2].decode("ascii")
    return found


def _pairs(files: Iterable[SourceFile], tracked: dict[str, str]) -> Iterable[tuple[str, str]]:
    return (
        (file.path, tracked[file.path])
        for file in files
        if file.content_hash and tracked.get(file.path, file.content_hash) != file.content_hash
    )


def _differs(root: str, path: str, wanted: str) -> bool:
    """Look again at a file whose hash is another: git may keep it with other ends of lines."""
    try:
        content = read_bounded(f"{root}/{path}").replace(b"\r\n", b"\n")
    except OSError:
        return True
    return hashlib.sha1(b"blob %d\0" % len(content) + content, usedforsecurity=False).hexdigest() != wanted


def _git(root: str, command: str, *arguments: str) -> bytes:
    try:
        done = subprocess.run(
            git_words(root, command, *arguments), capture_output=True, timeout=_LIMIT_S, check=False,
            stdin=subprocess.DEVNULL, env=git_environment(os.environ),
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired):
        return b""
    return done.stdout if done.returncode == 0 else b""
