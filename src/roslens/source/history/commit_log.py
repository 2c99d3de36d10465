"""The commits of a repository as values: who changed how much of which file, and when."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec


class Change(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """What a commit changed of one file.

    Attributes:
        path: its place in :attr:`CommitLog.paths`.
        added: lines; 0 of a binary file.
        deleted: lines; 0 of a binary file.
    """

    path: int
    added: int = 0
    deleted: int = 0


class Rename(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """A file that a commit gave another path, as git finds it by how alike the contents are.

    Attributes:
        old: place of the path before in :attr:`CommitLog.paths`.
        new: place of the path afterwards.
        added: lines that the content before has not.
        deleted: lines that the content afterwards has not.
    """

    old: int
    new: int
    added: int = 0
    deleted: int = 0


class Commit(msgspec.Struct, frozen=True, array_like=True):
    """One commit.

    Attributes:
        id: git's hash.
        parents: their hashes; none of a first commit, two or more of a merge.
        time_s: when it was committed, in seconds since 1970, as the committer's clock had it.
        people: author and co-authors, as places in :attr:`CommitLog.people`; each once.
        changes: against its parent, those of a renamed file under both paths; empty for a merge.
        renames: which of these are of one file.
    """

    id: str
    parents: tuple[str, ...]
    time_s: int
    people: tuple[int, ...]
    changes: tuple[Change, ...] = ()
    renames: tuple[Rename, ...] = ()

    @property
    def is_merge(self) -> bool:
        """Whether it has several parents."""
        return len(self.parents) > 1


class CommitLog(msgspec.Struct, frozen=True, array_like=True):
    """All commits that a head has behind it, children before their parents.

    Attributes:
        commits: the head first.
        paths: of files, below the root of the repository.
        people: one text for each, the same for all names that ``.mailmap`` makes one; no names.
        has_lines: whether lines were counted; not in a clone without contents.
        has_changes: whether it is known which files a commit changed; not in a clone without lists of files.
    """

    commits: tuple[Commit, ...] = ()
    paths: tuple[str, ...] = ()
    people: tuple[str, ...] = ()
    has_lines: bool = True
    has_changes: bool = True

    @property
    def head(self) -> Commit | None:
        """The newest commit; None where there is none."""
        return self.commits[0] if self.commits else None


def behind(log: CommitLog, head: str) -> CommitLog:
    """Return the log as it was at a commit: that commit and all behind it."""
    return msgspec.structs.replace(log, commits=tuple(_behind(log, head)))


def _behind(log: CommitLog, head: str) -> Iterator[Commit]:
    wanted = {head}
    for commit in log.commits:
        if commit.id in wanted:
            wanted.update(commit.parents)
            yield commit


def skewed(log: CommitLog) -> tuple[int, int]:
    """Return how many commits are dated before one of their parents, and by how many seconds the worst of them."""
    times = {commit.id: commit.time_s for commit in log.commits}
    late = [
        most
        for commit in log.commits
        if (most := max((times.get(parent, 0) for parent in commit.parents), default=0) - commit.time_s) > 0
    ]
    return len(late), max(late, default=0)
