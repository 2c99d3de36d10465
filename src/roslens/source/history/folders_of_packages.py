"""In which folder each package lay at each commit: by the moves that are behind the commit, and not by dates.

A commit of a branch beside the one that moved a package stands above or below the move in git's order, as dates have
it; in its tree the package is where it was.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec

from roslens.source.history.commit_log import Commit, CommitLog
from roslens.source.history.moved_packages import MovedPackages, before_moves


class _Move(msgspec.Struct, frozen=True):
    """A package that a commit moved; sets of moves are bits of a number, by their place in the log.

    Attributes:
        old: the earlier folder.
        new: the later folder.
        behind: the moves by the commit itself and by those behind it.
    """

    old: str
    new: str
    behind: int


class FoldersOfPackages:
    """Tells where packages of a head lay at the commits behind it."""

    def __init__(self, log: CommitLog) -> None:
        """Find the moves of a log, and which of them are behind each commit."""
        moved = MovedPackages(log.paths)
        own = {commit.id: moves for commit in log.commits if (moves := moved.moved_by(commit))}
        self._own: dict[str, tuple[int, ...]] = {}
        pairs: list[tuple[str, str]] = []
        for commit in log.commits:
            made = own.get(commit.id, {})
            if made:
                self._own[commit.id] = tuple(range(len(pairs), len(pairs) + len(made)))
                pairs += [(old, new) for new, old in made.items()]
        self._behind = _behind(log, self._own) if pairs else {}
        at = {number: commit for commit, numbers in self._own.items() for number in numbers}
        self._moves = tuple(_Move(old, new, self._behind[at[number]]) for number, (old, new) in enumerate(pairs))

    def at(self, head: Commit, packages: Mapping[str, str]) -> FoldersAtCommits:
        """Return where packages lay at the commits behind a head.

        Args:
            head: a commit of the log.
            packages: package by folder at the head; the folder of the root is empty.
        """
        return FoldersAtCommits(self, head, packages)

    def moves_of(self, commit: Commit) -> Mapping[str, str]:
        """Return the earlier folder by the later one of each package that a commit moved."""
        return {self._moves[one].new: self._moves[one].old for one in self._own.get(commit.id, ())}

    def behind(self, commit: Commit) -> int:
        """Return the moves by a commit and by those behind it."""
        return self._behind.get(commit.id, 0)

    def not_yet(self, behind: int, head: int) -> Iterator[Mapping[str, str]]:
        """Yield the moves that are behind a head and were not made where others are behind, the latest first.

        One that was made on both of two branches, before they came together, was made wherever it is behind either.
        """
        for number in _bits(head & ~behind):
            move = self._moves[number]
            if not any(self._is_same(number, other) for other in _bits(behind)):
                yield {move.new: move.old}

    def _is_same(self, number: int, other: int) -> bool:
        one, two = self._moves[number], self._moves[other]
        beside = not (one.behind >> other & 1 or two.behind >> number & 1)
        return beside and (one.old, one.new) == (two.old, two.new)


class FoldersAtCommits:
    """The folders of packages at each commit behind a head; commits with the same moves behind them share them."""

    def __init__(self, history: FoldersOfPackages, head: Commit, packages: Mapping[str, str]) -> None:
        """Take what :meth:`FoldersOfPackages.at` was given."""
        self._history = history
        self._head = history.behind(head)
        self._known: dict[int, Mapping[str, str]] = {self._head: packages}

    def after(self, commit: Commit) -> Mapping[str, str]:
        """Return the package by its folder in the tree of a commit."""
        behind = self._history.behind(commit)
        if behind not in self._known:
            folders = self._known[self._head]
            for moves in self._history.not_yet(behind, self._head):
                folders = _undone(folders, moves)
            self._known[behind] = folders
        return self._known[behind]

    def changed_by(self, commit: Commit) -> Mapping[str, str]:
        """Return the package by its folder before or after a commit: one that it moved has both."""
        folders = self.after(commit)
        moves = self._history.moves_of(commit)
        return {**folders, **_undone(folders, moves)} if moves else folders


def _undone(folders: Mapping[str, str], moves: Mapping[str, str]) -> Mapping[str, str]:
    known = {new: old for new, old in moves.items() if new in folders}
    return before_moves(folders, known) if known else folders


def _behind(log: CommitLog, own: Mapping[str, tuple[int, ...]]) -> dict[str, int]:
    """Return, as bits, the moves by each commit and by those behind it."""
    found: dict[str, int] = {}
    for commit in reversed(log.commits):
        bits = 0
        for parent in commit.parents:
            bits |= found.get(parent, 0)
        for number in own.get(commit.id, ()):
            bits |= 1 << number
        found[commit.id] = bits
    return found


def _bits(number: int) -> Iterator[int]:
    while number:
        lowest = number & -number
        yield lowest.bit_length() - 1
        number ^= lowest
