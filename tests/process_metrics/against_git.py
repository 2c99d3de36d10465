"""What roslens says of a history, and what git says of it, side by side."""

from __future__ import annotations

import os
import shlex
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

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
    entities: list[tuple[EntityKind, str, list[str], Mapping[str, float]]] = [
        (EntityKind.REPOSITORY, ".", [], found.values)
    ]
    for one, path in paths.items():
        earlier = earlier_folders(folder, path)
        # A folder that holds more than the package did is its own only until it was moved, which no command tells.
        if not any(_holds(old, other) for old in earlier for other in paths.values()):
            entities.append((EntityKind.PACKAGE, one, _pathspec(path, paths.values(), earlier), found.packages[one]))
    files = sorted(found.files, key=lambda path: -found.files[path]["revisions"])[:most_files]
    files = [path for path in files if not was_copied(folder, path)]
    entities += [(EntityKind.FILE, path, [f":(literal){path}"], found.files[path]) for path in files]
    compared, wrong = 0, []
    for kind, name, pathspec, values in entities:
        for quantity, gits in _answers(folder, kind, pathspec, found):
            compared += 1
            ours = values.get(quantity)
            same = ours is not None and (int(ours) == gits if quantity in DAYS else abs(ours - gits) < 1e-5)
            if not same:
                wrong.append(Difference(f"{kind.value}:{name}", quantity, ours, gits))
    for pair in found.coupled_files[:20]:
        if was_copied(folder, pair.first) or was_copied(folder, pair.second):
            continue
        compared += 1
        if (gits := _shared(folder, pair.first, pair.second)) != pair.shared:
            wrong.append(Difference(f"file:{pair.first} with {pair.second}", "change_coupling", pair.shared, gits))
    return compared, wrong


def earlier_folders(folder: Path, path: str) -> list[str]:
    """Return the folders that a package was in before, as git follows its manifest."""
    manifest = shlex.quote("package.xml" if path == "." else f"{path}/package.xml")
    said = asked(
        folder,
        f"git log --follow --topo-order --no-merges --diff-filter=R --name-status --format= HEAD -- {manifest}",
    )
    return [line.split("\t")[1].rpartition("/")[0] for line in said.splitlines()]


def _holds(folder: str, other: str) -> bool:
    return folder in ("", other) or other.startswith(f"{folder}/")


def _pathspec(path: str, others: Sequence[str], earlier: Sequence[str] = ()) -> list[str]:
    below = "" if path == "." else f"{path}/"
    inner = [other for other in others if other != path and other.startswith(below)]
    return [path, *earlier, *(f":(exclude){other}" for other in inner)]


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
    sizes = (
        asked(folder, f"git diff-tree --root --no-commit-id --no-renames --name-only -r {commit} | wc -l")
        for commit in both
    )
    return sum(int(size) <= change_coupling.LARGEST_COMMIT for size in sizes)


def was_copied(folder: Path, path: str) -> bool:
    """Return whether git follows a file to one that it was copied from, which is no renaming."""
    said = asked(
        folder, f"git log --follow --topo-order --no-merges --name-status --format= HEAD -- {shlex.quote(path)}"
    )
    return any(line.startswith("C") for line in said.splitlines())


def asked(folder: Path, command: str) -> str:
    """Return what a command of the shell writes in a folder."""
    environment = {**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_NOSYSTEM": "1", "LC_ALL": "C"}
    environment |= {"GIT_CONFIG_COUNT": "1", "GIT_CONFIG_KEY_0": "safe.directory", "GIT_CONFIG_VALUE_0": "*"}
    done = subprocess.run(
        ["bash", "-c", command], cwd=folder, capture_output=True, text=True, check=False, env=environment, timeout=300
    )
    return done.stdout.strip()
