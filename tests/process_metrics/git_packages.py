"""Which commits git says are a package's, under every folder that it was in.

As the page of process metrics says it: a package moves with a commit in which git finds its manifest again under
another folder, where the folder keeps its own name or most files that came to it by renaming came with it. That
commit and what git lists with it under `--ancestry-path` are of the later folder, all else of the earlier one. Commits
and renames are those that git names; nothing of roslens takes part.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from process_metrics.git_commands import asked, lines_of

MANIFESTS = ("package.xml", "manifest.xml")
RELEASES = (":(exclude,glob)**/package.xml", ":(exclude,glob)**/CHANGELOG.*")
"""What releases change, and change coupling leaves out; at the top, too, where ``**/`` stands for no folder."""


class Part(NamedTuple):
    """Commits that are of a package under one pathspec."""

    pathspec: tuple[str, ...]
    commits: tuple[str, ...]


class Move(NamedTuple):
    """A package that a commit moved from one folder to another."""

    commit: str
    old: str
    new: str


class GitPackages:
    """The packages of a clone, by folder at its head."""

    def __init__(self, folder: Path, packages: Mapping[str, str]) -> None:
        """Ask git for all commits and renames.

        Args:
            folder: the work tree.
            packages: folder by package; ``.`` for the top.
        """
        self._folder = folder
        self._listed: dict[tuple[str, ...], frozenset[str]] = {}
        order = lines_of(folder, "git log --topo-order --no-merges --format=%H HEAD")
        made = [Move(one, *pair) for one, rows in _renames(folder).items() for pair in _moves(rows)]
        made.sort(key=lambda move: order.index(move.commit))
        after = [{one.commit, *lines_of(folder, f"git rev-list --ancestry-path {one.commit}..HEAD")} for one in made]
        self._layouts = list(_layouts(order, made, after, {_plain(path): one for one, path in packages.items()}))
        self.moved = frozenset(
            package for package in packages if len({one for _, held in self._layouts for one in _at(held, package)}) > 1
        )
        """Packages that were in another folder."""

    def parts(self, package: str, without: Sequence[str] = ()) -> list[Part]:
        """Return what is of a package; ``without`` are further pathspecs that are left out."""
        found = []
        for commits, folders in self._layouts:
            if own := _at(folders, package):
                inner = [one for one in folders if folders[one] != package and _is_inside(one, own)]
                spec = (*(one or "." for one in own), *(f":(exclude){one}" for one in inner), *without)
                found.append(Part(spec, tuple(one for one in commits if one in self._touching(spec))))
        return [one for one in found if one.commits]

    def _touching(self, spec: tuple[str, ...]) -> frozenset[str]:
        if spec not in self._listed:
            command = 'git log --topo-order --no-merges --full-history --format=%H HEAD -- "$@"'
            self._listed[spec] = frozenset(lines_of(self._folder, command, spec))
        return self._listed[spec]

    def answers(self, package: str) -> dict[str, float]:
        """Return what git says of a package's commits, by quantity."""
        parts = self.parts(package)
        commits = [one for part in parts for one in part.commits]
        people = "git shortlog -sn --no-walk --group=author --group=trailer:co-authored-by \"$@\" | awk '{print $1}'"
        shares = [int(one) for one in self._of(people, commits)]
        times = [int(one) for one in self._of('git log --no-walk --format=%ct "$@"', commits)]
        head = int(asked(self._folder, "git log -1 --format=%ct HEAD"))
        half, least = sum(shares) / 2, 0
        while sum(shares[:least]) < half:
            least += 1
        return {
            "revisions": len(commits),
            "contributors": len(shares),
            "age": max(0, head - min(times)) // 86_400,
            "time_since_last_commit": max(0, head - max(times)) // 86_400,
            "churn": sum(self._churn(part) for part in parts),
            "ownership": shares[0] / sum(shares),
            "bus_factor": least,
        }

    def shared(self, first: str, second: str, most_files: int) -> int:
        """Return how many commits change both packages, of those that change few enough files; no releases."""
        sets = [{one for part in self.parts(name, RELEASES) for one in part.commits} for name in (first, second)]
        return sum(files_of(self._folder, one) <= most_files for one in set.intersection(*sets))

    def _of(self, command: str, commits: Sequence[str]) -> list[str]:
        return lines_of(self._folder, command, commits)

    def _churn(self, part: Part) -> int:
        command = (
            'git log --no-walk=unsorted --no-renames --numstat --format= "${@:2:$1}" -- "${@:$1+2}"'
            " | awk '{n += $1 + $2} END {print n + 0}'"
        )
        return int(asked(self._folder, command, str(len(part.commits)), *part.commits, *part.pathspec))


def files_of(folder: Path, commit: str) -> int:
    """Return how many files a commit changes."""
    return int(asked(folder, f"git diff-tree --root --no-commit-id --no-renames --name-only -r {commit} | wc -l"))


def _renames(folder: Path) -> dict[str, list[tuple[str, str]]]:
    """Return earlier and later path of each file that a commit renamed, by its hash."""
    said = asked(
        folder, "git -c core.quotePath=false log --topo-order --no-merges --diff-filter=R --find-renames -l1000 "
        "--ignore-submodules=none --name-status --format=%x01%H HEAD",
    )  # fmt: skip
    found = {}
    for block in said.split("\x01")[1:]:
        commit, *rows = block.strip().splitlines()
        found[commit] = [(old, new) for _, old, new in (row.split("\t") for row in rows if row)]
    return found


Layout = tuple[Sequence[str], Mapping[str, str]]
"""Commits, and which package has which folder in them; the top is the empty one."""


def _layouts(
    order: Sequence[str], made: Sequence[Move], after: Sequence[AbstractSet[str]], folders: Mapping[str, str]
) -> Iterator[Layout]:
    """Group commits by which moves they are not after; ``made`` has the latest move first, ``after`` its commits."""
    groups: dict[tuple[tuple[int, ...], str], list[str]] = {}
    for commit in order:
        undone = tuple(one for one in range(len(made)) if not _was_made(one, commit, made, after))
        groups.setdefault((undone, commit if any(one.commit == commit for one in made) else ""), []).append(commit)
    for (undone, mover), commits in groups.items():
        here = dict(folders)
        for number in undone:
            here = _undone(here, [made[number]])
        yield commits, {**here, **_undone(here, [one for one in made if mover == one.commit])}


def _was_made(number: int, commit: str, made: Sequence[Move], after: Sequence[AbstractSet[str]]) -> bool:
    """Return whether a commit is after a move, or after the same one as another branch made it."""
    if commit in after[number]:
        return True
    move = made[number]
    return any(
        (one.old, one.new) == (move.old, move.new) and commit in after[other]
        and one.commit not in after[number] and move.commit not in after[other]
        for other, one in enumerate(made)
    )  # fmt: skip


def _undone(folders: Mapping[str, str], made: Sequence[Move]) -> dict[str, str]:
    """Return the folders before some moves; who has one that another came from got it later."""
    moves = {one.new: one.old for one in made if one.new in folders}
    staying = {folder: package for folder, package in folders.items() if folder not in moves}
    return {**staying, **{old: folders[new] for new, old in moves.items()}}


def _moves(renamed: Sequence[tuple[str, str]]) -> Iterator[tuple[str, str]]:
    """Yield earlier and later folder of each package that a commit moved."""
    for old, new in renamed:
        one, other = PurePosixPath(old), PurePosixPath(new)
        if one.name in MANIFESTS and other.name in MANIFESTS and one.parent != other.parent:
            came = [pair for pair in renamed if _goes_with(pair[1], other)]
            along = [
                pair for pair in came
                if _goes_with(pair[0], one)
                and PurePosixPath(pair[0]).relative_to(one.parent) == PurePosixPath(pair[1]).relative_to(other.parent)
            ]  # fmt: skip
            keeps_name = one.parent.name == other.parent.name != ""
            if keeps_name or (along and 2 * len(along) >= len(came)):
                yield _plain(str(one.parent)), _plain(str(other.parent))


def _goes_with(path: str, manifest: PurePosixPath) -> bool:
    """Return whether a file is below the folder of a manifest, and none itself."""
    one = PurePosixPath(path)
    return one.is_relative_to(manifest.parent) and one.name not in MANIFESTS


def _plain(folder: str) -> str:
    return "" if folder == "." else folder


def _at(folders: Mapping[str, str], package: str) -> tuple[str, ...]:
    return tuple(folder for folder, one in folders.items() if one == package)


def _is_inside(folder: str, above: Sequence[str]) -> bool:
    return any(folder != one and (one == "" or folder.startswith(f"{one}/")) for one in above)
