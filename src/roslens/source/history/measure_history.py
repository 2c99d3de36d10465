"""All process metrics of one repository, computed of its log."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence

from roslens.model.entity import EntityKind
from roslens.model.process import Coupling, Release, RepositoryProcess
from roslens.source.history.commit_log import Change, Commit, CommitLog, skewed
from roslens.source.history.followed_files import followed_files
from roslens.source.history.metrics import change_coupling, hotspot, releases, revisions_since_release
from roslens.source.history.metrics.table import PROCESS_METRICS
from roslens.source.history.parts_of_commits import PartsOfCommits
from roslens.source.history.touched import Touched

Commits = list[tuple[Commit, Sequence[Change]]]


def measure_history(
    log: CommitLog,
    released: Sequence[Release],
    *,
    path: str,
    packages: Mapping[str, str],
    files: Mapping[str, str],
    complexity: Mapping[str, float],
    as_of_s: float | None = None,
    parts: PartsOfCommits | None = None,
) -> RepositoryProcess:
    """Return what the log says of a repository, its packages and their files.

    Args:
        log: with at least one commit.
        released: releases among its commits, in any order.
        path: of the repository below the root of the workspace.
        packages: folder below the root of the repository by package id; a file belongs to the innermost.
        files: path below the root of the workspace by path below that of the repository, of files to measure.
        complexity: of all functions of a file together, by path below the root of the workspace.
        as_of_s: the time at which ages are taken, in seconds since 1970; None for the head's own.
        parts: of the commits of this log or of a later one, where several heads of one log are asked for.
    """
    head = log.commits[0]
    at_s = head.time_s if as_of_s is None else as_of_s
    of_package: dict[str, Commits] = defaultdict(list)
    coupling: list[tuple[int, frozenset[str]]] = []
    for commit, parted in (parts or PartsOfCommits(log)).along(log.commits, packages):
        for owner, changes in parted.changes:
            of_package[owner].append((commit, changes))
        if commit.changes:
            coupling.append((len(commit.changes), parted.coupled))
    of_file = _commits_of_files(log, files) if files else {}
    whole: Commits = [(commit, commit.changes) for commit in log.commits]
    coupled_files = change_coupling.couplings(_coupled_files(log, files)) if files else ()
    coupled_packages = change_coupling.couplings(coupling)

    def values(kind: EntityKind, commits: Commits) -> dict[str, float]:
        touched = Touched(kind, commits, as_of_s=at_s, head_s=head.time_s)
        return dict(_values(touched, lines=log.has_lines))

    file_values = {name: values(EntityKind.FILE, of_file[name]) for name in files.values() if name in of_file}
    _add_hotspots(file_values, complexity)
    package_values = {one: values(EntityKind.PACKAGE, of_package[one]) for one in packages if one in of_package}
    if log.has_changes:
        _add_partners(file_values, coupled_files)
        _add_partners(package_values, coupled_packages)
    times = skewed(log)
    newest = tuple(sorted(released, key=lambda one: (-one.time_s, one.name)))
    since = revisions_since_release.of_log(log, newest)
    return RepositoryProcess(
        path,
        head.id,
        head.time_s,
        at_s,
        *times,
        values={
            **values(EntityKind.REPOSITORY, whole),
            releases.QUANTITY.key: releases.of_releases(newest),
            **({} if since is None else {revisions_since_release.QUANTITY.key: since}),
        },
        packages=package_values,
        files=file_values,
        coupled_files=coupled_files,
        coupled_packages=coupled_packages,
        releases=newest,
    )


def _commits_of_files(log: CommitLog, files: Mapping[str, str]) -> dict[str, Commits]:
    """Return the commits that changed each file, through all its names."""
    found: dict[str, Commits] = defaultdict(list)
    for commit, changed in followed_files(log, files):
        for name, change in changed.items():
            found[name].append((commit, [change]))
    return found


def _add_hotspots(values: Mapping[str, dict[str, float]], complexity: Mapping[str, float]) -> None:
    """Add to the values of files what their churn and the complexity of their functions come to."""
    for name, known in values.items():
        product = hotspot.of_file(known["churn"], complexity.get(name)) if "churn" in known else None
        if product is not None:
            known[hotspot.QUANTITY.key] = product


def _values(touched: Touched, *, lines: bool) -> Iterator[tuple[str, float]]:
    for metric in PROCESS_METRICS:
        quantity = metric.QUANTITY
        if touched.kind not in quantity.kinds or not hasattr(metric, "of_touched"):
            continue
        if getattr(metric, "NEEDS_LINES", False) and not lines:
            continue
        value = metric.of_touched(touched)
        if value is not None:
            yield quantity.key, float(value)


def _coupled_files(log: CommitLog, files: Mapping[str, str]) -> Iterator[tuple[int, frozenset[str]]]:
    """Yield how many files each commit changes, and those among them that are measured and no mere release."""
    coupling = {path: name for path, name in files.items() if not change_coupling.RELEASE_FILES.fullmatch(path)}
    for commit, changed in followed_files(log, coupling):
        if commit.changes:
            yield len(commit.changes), frozenset(changed)


def _add_partners(values: dict[str, dict[str, float]], found: Iterable[Coupling]) -> None:
    numbers = change_coupling.partners(found)
    for name, known in values.items():
        known[change_coupling.QUANTITY.key] = float(numbers[name])
