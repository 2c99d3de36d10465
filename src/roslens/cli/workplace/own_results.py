"""Whether what is kept of a workspace was made by this user: a clone must not bring its own clean verdict.

A folder ``.roslens`` that roslens made has a mark that only this user can make. One without it, one that git tracks,
a link, or one that belongs to another user is refused: a store in it could have its findings deleted.
"""

from __future__ import annotations

import hmac
import os
import stat
import subprocess
from collections.abc import Mapping
from pathlib import Path

from roslens.children.git import git_environment, git_words, looks_bare
from roslens.cli.workplace.user_folder import user_secret, write_private
from roslens.intake.bounded_file import read_bounded
from roslens.model.errors import UsageError

MARK = "maker"
_KEPT = ("store.sqlite", "changed.sqlite", "cache.sqlite", "history.sqlite")
_GIT_LIMIT_S = 10.0


def refuse_foreign(folder: Path, environment: Mapping[str, str]) -> None:
    """Refuse what is kept in ``folder`` unless this user made it; a folder that is not there is fine.

    Raises:
        UsageError: it may be of someone else.
    """
    try:
        found = folder.lstat()
    except OSError:
        return
    if reason := _strange(folder, found) or _tracked(folder) or _unmarked(folder, environment):
        raise UsageError(
            f"{str(folder)!r} {reason}",
            expected="results that roslens wrote for you, on this machine",
            advice=f"`roslens clean --all {folder.parent}` removes it; or use --no-store --no-cache. "
            "A CI that keeps it between runs has to keep the file `secret` in $XDG_CONFIG_HOME/roslens too",
        )


def mark_own(folder: Path, environment: Mapping[str, str]) -> None:
    """Mark a folder as made by this user.

    Raises:
        OSError: it cannot be written.
    """
    if not (folder / MARK).exists():
        write_private(folder / MARK, _mark(environment))


def _mark(environment: Mapping[str, str]) -> bytes:
    return hmac.new(user_secret(environment), b"results of roslens", "sha256").hexdigest().encode()


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
    return "" if hmac.compare_digest(content, _mark(environment)) else "was made by another user"
