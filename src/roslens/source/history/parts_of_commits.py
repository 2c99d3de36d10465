"""What each commit of a log changed of each package: worked out once, for all past revisions that ask for it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import msgspec

from roslens.source.history.commit_log import Change, Commit, CommitLog
from roslens.source.history.folders_of_packages import FoldersOfPackages
from roslens.source.history.metrics.change_coupling import RELEASE_FILES

_MOST_LAYOUTS = 64
"""Revisions next to each other mostly have the same packages in the same folders, and each move makes one more."""


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
        self._lay = FoldersOfPackages(log)
        self._layouts: dict[tuple[tuple[str, str], ...], _Layout] = {}

    def along(self, commits: Iterable[Commit], packages: Mapping[str, str]) -> Iterator[tuple[Commit, Parts]]:
        """Yield each commit that is no merge with its parts; packages are followed back to where they were before.

        A commit that moves a package changes it in both folders.

        Args:
            commits: the head first, children before their parents.
            packages: folder below the root of the repository by package id, at the first of the commits; a file belongs
                to the innermost.
        """
        folders = {"" if folder == "." else folder: package for package, folder in packages.items()}
        lay = layout = None
        at: Mapping[str, str] | None = None
        for commit in commits:
            lay = lay or self._lay.at(commit, folders)
            if commit.is_merge:
                continue
            now = lay.changed_by(commit)
            if layout is None or now is not at:
                at, layout = now, self._of(now)
            yield commit, layout.parts(commit)

    def _of(self, folders: Mapping[str, str]) -> _Layout:
        key = tuple(sorted(folders.items()))
        if key not in self._layouts:
            if len(self._layouts) >= _MOST_LAYOUTS:
                del self._layouts[next(iter(self._layouts))]
            self._layouts[key] = _Layout(owners_of(self._paths, folders), self._couples)
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


def owners_of(paths: Sequence[str], folders: Mapping[str, str]) -> list[str]:
    """Return the id of the package that each path is in; empty for none.

    Args:
        paths: of files.
        folders: package by folder; that of the root is empty.
    """
    known: dict[str, str] = {}

    def owner(folder: str) -> str:
        if folder not in known:
            above = folder.rpartition("/")[0] if folder else ""
            known[folder] = folders[folder] if folder in folders else owner(above) if folder else ""
        return known[folder]

    return [owner(path.rpartition("/")[0]) for path in paths]
