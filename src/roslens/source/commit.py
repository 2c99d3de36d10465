"""Which commit a folder is at."""

from __future__ import annotations

import subprocess


def commit_of(root: str) -> str:
    """Return the commit id of the repository that ``root`` is in, with ``+`` where the tree differs.

    Empty where there is no repository, no commit or no git.
    """
    head = _git(root, "rev-parse", "HEAD")
    if not head:
        return ""
    differs = _git(root, "status", "--porcelain", "--untracked-files=no", "--ignore-submodules", "--", ".")
    return f"{head}+" if differs else head


def _git(root: str, *arguments: str) -> str:
    # A look at a repository must start no program that it configures (fsmonitor, hooks), and write nothing into it.
    quietly = ("--no-optional-locks", "-c", "core.fsmonitor=false", "-c", "core.hooksPath=/dev/null")
    command = ["git", *quietly, "-C", root, *arguments]
    try:
        done = subprocess.run(command, capture_output=True, timeout=20, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.decode("utf-8", "replace").strip() if done.returncode == 0 else ""
