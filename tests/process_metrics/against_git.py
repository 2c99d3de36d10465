"""What roslens says of a history, and what git says of it, side by side."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import msgspec

from process_metrics.git_commands import asked
from process_metrics.git_packages import GitPackages, files_of
from roslens.model.entity import EntityKind
from roslens.model.process import RepositoryProcess
from roslens.source.history.histories import histories_of, log_reader
from roslens.source.history.metrics import (
    age,
    change_coupling,
    hotspot,
    revisions_since_release,
    time_since_last_commit,
)
from roslens.source.history.metrics.table import PROCESS_METRICS
from roslens.source.inventory import take_inventory
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.find import find_workspace
from roslens.store.cache import Cache

DAYS = {age.QUANTITY.key, time_since_last_commit.QUANTITY.key}
"""Which git's commands tell in whole days."""


class Difference(msgspec.Struct, frozen=True):
    """An answer that is not git's."""

    entity: str
    quantity: str
    ours: float | None
    gits: float


def process_of(folder: Path, *, as_of_s: float | None = None) -> RepositoryProcess:
    """Return what roslens says of the only repository of a workspace."""
    workspace = find_workspace([folder], WorkspaceSettings())
    inventory = take_inventory(workspace, WorkspaceSettings(), {})
    histories = histories_of(workspace, as_of_s=as_of_s)
    assert not histories.failures, histories.failures
    packages = {found.package.id: found.package.path for found in workspace.packages}
    with Cache.open(None) as cache:
        (found,), failures = histories.measure(packages, inventory.files, {}, log_reader(cache))
    assert not failures
    return found


def differences(folder: Path, *, most_files: int = 40) -> tuple[int, list[Difference]]:
    """Return how many answers were compared, and those that differ.

    Args:
        folder: the work tree of a repository with all its commits.
        most_files: so many files are asked for, those with most commits.
    """
    found = process_of(folder)
    workspace = find_workspace([folder], WorkspaceSettings())
    paths = {one.package.id: one.package.path for one in workspace.packages if one.package.id in found.packages}
    of_git = GitPackages(folder, paths)
    entities: list[tuple[EntityKind, str, list[str], Mapping[str, float]]] = [
        (EntityKind.REPOSITORY, ".", [], found.values)
    ]
    if not of_git.moved:
        # What stays in its folder is asked for by the commands that the pages name.
        entities += [
            (EntityKind.PACKAGE, one, _pathspec(path, paths.values()), found.packages[one])
            for one, path in paths.items()
        ]
    files = sorted(found.files, key=lambda path: -found.files[path]["revisions"])[:most_files]
    files = [path for path in files if not was_copied(folder, path)]
    entities += [(EntityKind.FILE, path, [f":(literal){path}"], found.files[path]) for path in files]
    compared, wrong = 0, []

    def hold(entity: str, quantity: str, ours: float | None, gits: float) -> None:
        nonlocal compared
        compared += 1
        same = ours is not None and (int(ours) == gits if quantity in DAYS else abs(ours - gits) < 1e-5)
        if not same:
            wrong.append(Difference(entity, quantity, ours, gits))

    for kind, name, pathspec, values in entities:
        for quantity, gits in _answers(folder, kind, pathspec, found):
            hold(f"{kind.value}:{name}", quantity, values.get(quantity), gits)
    for name in paths if of_git.moved else ():
        for quantity, gits in of_git.answers(name).items():
            hold(f"package:{name}", quantity, found.packages[name].get(quantity), gits)
    for pair in found.coupled_files[:20]:
        if not was_copied(folder, pair.first) and not was_copied(folder, pair.second):
            gits = _shared(folder, pair.first, pair.second)
            hold(f"file:{pair.first} with {pair.second}", change_coupling.QUANTITY.key, pair.shared, gits)
    for pair in found.coupled_packages[:20]:
        gits = of_git.shared(pair.first, pair.second, change_coupling.LARGEST_COMMIT)
        hold(f"package:{pair.first} with {pair.second}", change_coupling.QUANTITY.key, pair.shared, gits)
    return compared, wrong


def _pathspec(path: str, others: Iterable[str]) -> list[str]:
    below = "" if path == "." else f"{path}/"
    inner = [other for other in others if other != path and other.startswith(below)]
    return [path, *(f":(exclude){other}" for other in inner)]


def _answers(
    folder: Path, kind: EntityKind, pathspec: list[str], found: RepositoryProcess
) -> Iterator[tuple[str, float]]:
    for metric in PROCESS_METRICS:
        which = "path" if kind is EntityKind.PACKAGE else kind.value
        if metric in (hotspot, change_coupling) or kind not in metric.QUANTITY.kinds or which not in metric.COMMANDS:
            continue
        command = metric.COMMANDS[which]
        if metric is revisions_since_release:
            if not found.releases:
                continue
            newest = asked(folder, f"git log --topo-order --format=%H HEAD | grep -m1 -F '{_tagged(found)}'")
            command = command.replace("TAG", newest)
        words = " ".join(shlex.quote(word) for word in pathspec)
        yield metric.QUANTITY.key, float(asked(folder, command.replace("PATH", words)) or 0)


def _tagged(found: RepositoryProcess) -> str:
    return "\n".join(one.commit for one in found.releases)


def _shared(folder: Path, first: str, second: str) -> int:
    """Return how many commits change both, of those that are no merge and change few enough files."""
    form = "git log --follow --topo-order --no-merges --format=%H HEAD -- {} | sort"
    both = asked(folder, f"comm -12 <({form.format(shlex.quote(first))}) <({form.format(shlex.quote(second))})").split()
    return sum(files_of(folder, commit) <= change_coupling.LARGEST_COMMIT for commit in both)


def was_copied(folder: Path, path: str) -> bool:
    """Return whether git follows a file to one that it was copied from, which is no renaming."""
    said = asked(
        folder, f"git log --follow --topo-order --no-merges --name-status --format= HEAD -- {shlex.quote(path)}"
    )
    return any(line.startswith("C") for line in said.splitlines())
