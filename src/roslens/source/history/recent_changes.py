"""How often files changed lately: files under development are worth correcting before files that no longer change."""

from __future__ import annotations

import os
from collections import Counter

from roslens.children.git import looks_bare
from roslens.source.history.git_answer import HistoryError, git_answer

YEAR_S = 365 * 24 * 3600
"""How far before the newest commit a change is a recent one, so that the order of an old repository is its own too."""
LIMIT_S = 5.0
"""How long git may take: an order is not worth more."""


def recent_changes(folder: str) -> dict[str, int]:
    """Return of the files below ``folder`` that changed within a year before its newest commit the number of commits.

    Merges do not count, a renamed file begins anew. Nothing is known where there is no repository, no git, or where it
    does not answer in :data:`LIMIT_S`; nor in a shallow clone, whose oldest commit seems to have changed every file.
    """
    if looks_bare(folder):
        return {}
    try:
        if git_answer(folder, "rev-parse", "--is-shallow-repository", limit_s=LIMIT_S).strip() == b"true":
            return {}
        newest = git_answer(folder, "log", "-1", "--format=%ct", "HEAD", limit_s=LIMIT_S)
        since = f"--since={int(newest) - YEAR_S}"
        names = git_answer(
            folder, "log", "--no-merges", "--no-renames", "--relative", "-z", "--name-only", "--format=", since, "HEAD",
            limit_s=LIMIT_S,
        )  # fmt: skip
    except (HistoryError, ValueError):
        return {}
    return dict(Counter(os.fsdecode(name.strip(b"\n")) for name in names.split(b"\0") if name.strip(b"\n")))
