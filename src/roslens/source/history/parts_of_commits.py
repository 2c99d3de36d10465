"""What each commit of a log changed of each package: worked out once, for all past revisions that are told of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.source.history.commit_log import Change, Commit, CommitLog
from roslens.source.history.metrics.change_coupling import RELEASE_FILES

_MOST_LAYOUTS = 4
"""Revisions next to each other mostly have the same packages in the same folders."""


class Parts(msgspec.Struct, frozen=True, gc=False):
    """What one commit changed: of each package, and of which packages something that says what belongs together."""

    changes: tuple[tuple[str, tuple[Change, ...]], ...]
    coupled: frozenset[str]


class PartsOfCommits:
    """The parts of commits, kept for some layouts of packages."""

    def __init__(self, log: CommitLog) -> None:
        """Take the log; commits of an earlier head of it are known by it, too."""
        self._paths = log.paths
        self._couples = [not RELEASE_FILES.fullmatch(name) for name in log.paths]
        self._layouts: dict[tuple[tuple[str, str], ...], _Layout] = {}

    def of(self, packages: Mapping[str, str]) -> _Layout:
        """Return what tells the parts of a commit.

        Args:
            packages: folder below the root of the repository by package id; a file belongs to the innermost.
        """
        key = tuple(sorted(packages.items()))
        if key not in self._layouts:
            if len(self._layouts) >= _MOST_LAYOUTS:
                del self._layouts[next(iter(self._layouts))]
            self._layouts[key] = _Layout(owners_of(self._paths, packages), self._couples)
        return self._layouts[key]


class _Layout:
    def __init__(self, owners: Sequence[str], couples: Sequence[bool]) -> None:
        self._owners = owners
        self._couples = couples
        self._known: dict[str, Parts] = {}

    def parts(self, commit: Commit) -> Parts:
        """Return the parts of a commit."""
        known = self._known.get(commit.id)
        if known is None:
            known = self._known[commit.id] = self._parts(commit)
        return known

    def _parts(self, commit: Commit) -> Parts:
        found: dict[str, list[Change]] = {}
        for change in commit.changes:
            found.setdefault(self._owners[change.path], []).append(change)
        coupled = frozenset(self._owners[one.path] for one in commit.changes if self._couples[one.path])
        return Parts(tuple((owner, tuple(changes)) for owner, changes in found.items()), coupled - {""})


def owners_of(paths: Sequence[str], packages: Mapping[str, str]) -> list[str]:
    """Return the id of the package that each path is in; empty for none."""
    folders = {("" if folder in ("", ".") else folder): package for package, folder in packages.items()}
    known: dict[str, str] = {}

    def owner(folder: str) -> str:
        if folder not in known:
            above = folder.rpartition("/")[0] if folder else ""
            known[folder] = folders[folder] if folder in folders else owner(above) if folder else ""
        return known[folder]

    return [owner(path.rpartition("/")[0]) for path in paths]
