"""Which revision of each repository is wanted: the newest, that of a day, a commit, or that after so many commits."""

from __future__ import annotations

import re
from datetime import date, datetime

import msgspec

from roslens.model.errors import UsageError
from roslens.source.fetch.git_runner import GitError, GitRunner
from roslens.source.fetch.wanted import Wanted

_COUNT = re.compile(r"[0-9]{1,6}\Z")
_COMMIT = re.compile(r"[0-9a-f]{7,40}\Z")
COUNTED = "count"
"""Stands for the number of commits that a filter names for each repository."""

_MOST_COMMITS = 15_000
"""Beyond them only the commits of the main line are looked at for a count."""


class At(msgspec.Struct, frozen=True):
    """A revision that is the same expression for every repository; all empty for the newest.

    Attributes:
        date: the last commit that was made before this moment, in ISO 8601.
        commit: the commit whose id begins so.
        commits: the commit that makes ``git rev-list --count`` so many.
        counted: as many as the filter says of each.
    """

    date: str = ""
    commit: str = ""
    commits: int = 0
    counted: bool = False

    def text(self) -> str:
        """Return what was given, for the lock."""
        return self.date or self.commit or (str(self.commits) if self.commits else COUNTED if self.counted else "")

    def count_of(self, wanted: Wanted) -> int:
        """Return how many commits the revision of a repository has; 0 where that is not asked for."""
        return wanted.commits if self.counted else self.commits


def parse_at(text: str) -> At:
    """Return the value of ``--at``.

    Raises:
        UsageError: it is no date, no commit, no number and not :data:`COUNTED`.
    """
    if text == COUNTED:
        return At(counted=True)
    if _COUNT.match(text) and int(text):
        return At(commits=int(text))
    if _COMMIT.match(text):
        return At(commit=text)
    for kind in (date, datetime):
        try:
            kind.fromisoformat(text)
        except ValueError:
            continue
        return At(date=text)
    raise UsageError(
        f"--at {text}",
        expected="a date (2015-10-16), a commit (7 to 40 of 0-9 and a-f), a number of commits, or `count` for the "
        "numbers of the filter",
    )


def revision_at(git: GitRunner, folder: str, tip: str, at: At, count: int) -> str:
    """Return the commit that ``at`` means among those behind ``tip``.

    Args:
        git: is asked.
        folder: of the clone.
        tip: the newest commit.
        at: what is wanted.
        count: the number of commits where that is what is wanted, else 0.

    Raises:
        GitError: there is none; the text states what comes nearest.
    """
    if at.commit:
        found = git.ask(folder, "rev-parse", "--verify", "--quiet", f"{at.commit}^{{commit}}")
        if not found:
            raise GitError(f"there is no commit {at.commit}")
        return found.strip()
    if at.date:
        # The whole day belongs to a date without a time.
        before = at.date if "T" in at.date or " " in at.date else f"{at.date}T23:59:59"
        found = git.do(folder, "rev-list", "-1", f"--before={before}", tip).strip()
        if not found:
            days = git.do(folder, "rev-list", "--max-parents=0", "--format=%cs", tip).splitlines()
            first = min((day for day in days if not day.startswith("commit ")), default="no day")
            raise GitError(f"there is no commit before {at.date}; the first is of {first}")
        return found
    return _after(git, folder, tip, count) if count else tip


def _after(git: GitRunner, folder: str, tip: str, count: int) -> str:
    """Return the commit with so many commits behind it and with it: of the main line if there is one there."""
    line = git.do(folder, "rev-list", "--first-parent", tip).split()
    low, high = 0, len(line) - 1
    while low < high:
        middle = (low + high) // 2
        if _count(git, folder, line[middle]) > count:
            low = middle + 1
        else:
            high = middle
    # `low` is the newest commit of the main line with at most so many.
    most = _count(git, folder, line[low])
    if most == count:
        return line[low]
    if found := _off_the_line(git, folder, tip, count):
        return found
    more = f", {line[low - 1][:12]} has {_count(git, folder, line[low - 1])}" if low else ""
    raise GitError(f"no commit has {count} commits behind it; {line[low][:12]} has {most}{more}")


def _count(git: GitRunner, folder: str, commit: str) -> int:
    return int(git.do(folder, "rev-list", "--count", commit))


def _off_the_line(git: GitRunner, folder: str, tip: str, count: int) -> str:
    """Return the newest commit of a side branch with so many behind it; empty where there is none."""
    listed = git.do(folder, "rev-list", "--topo-order", "--parents", tip).splitlines()
    if len(listed) > _MOST_COMMITS:
        return ""
    behind: dict[str, int] = {}
    found = ""
    for number, row in enumerate(reversed(listed)):
        commit, *parents = row.split()
        reached = 1 << number
        for parent in parents:
            reached |= behind.get(parent, 0)
        behind[commit] = reached
        if reached.bit_count() == count:
            found = commit
    return found
