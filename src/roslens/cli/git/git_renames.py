"""Which files have another path in a later revision, by git's detection of similar contents."""

from __future__ import annotations

import os

from roslens.cli.git.git_repository import Repository


def renamed_files(repository: Repository, before: str, after: str) -> dict[str, str]:
    """Return the later path of each file by its earlier one, both below the folder that is looked at.

    A file that came to that folder from elsewhere, or left it, is none of them. None if git cannot detect them.

    Args:
        repository: that has both.
        before: a commit.
        after: a commit.

    Raises:
        UsageError: git cannot be run.
    """
    options = ("-r", "--find-renames", "--diff-filter=R", "--name-status", "-z")
    done = repository.git("diff-tree", *options, before, after, "--", ":/")
    if done.returncode:
        return {}
    words = [os.fsdecode(word) for word in done.stdout.split(b"\0")]
    below = repository.below
    pairs = zip(words[1::3], words[2::3], strict=False)
    return {
        old[len(below) :]: new[len(below) :] for old, new in pairs if old.startswith(below) and new.startswith(below)
    }
