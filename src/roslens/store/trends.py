"""Quantities across runs: past revisions, and the tree as it was analysed last."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from datetime import datetime, timezone
from functools import cached_property
from pathlib import PurePath
from statistics import median

import msgspec

from roslens.model.finding import Severity
from roslens.model.process import Release
from roslens.model.quantity import Fold, Quantity
from roslens.model.result import PackageSummary, RunHeader
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.trend import Trend, TrendEvent, TrendPoint
from roslens.store.read import RunView
from roslens.store.revisions import KeptRevision
from roslens.store.runs import Store

Commits = tuple[tuple[str, str], ...]
IsBehind = Callable[[Commits], bool]

COUNTS = {
    "findings": "Findings",
    "errors": "Errors",
    "warnings": "Warnings",
    "notes": "Notes",
}
"""What can be followed besides quantities: findings that count for gates, all or of one severity."""

_SEVERITIES = {"errors": Severity.ERROR, "warnings": Severity.WARNING, "notes": Severity.NOTE}
_OF_REPOSITORIES = {"revisions", "churn", "releases", "revisions_since_release"}
"""What can be added up over repositories."""
_MOST_MOVED = 5
"""Packages of one event that are named."""
_SUMS = {"files", "classes", "functions", "rqv", "rcv"}


class Trends:
    """The runs of past revisions and of today, and their values of a quantity.

    Everything is read once: summaries of packages are shared by the runs in which a package did not change.
    ``other_root`` is the workspace of a run that was left out because it is another one's; empty for none.
    """

    def __init__(self, past: Store, now: RunView | None = None, behind: IsBehind | None = None) -> None:
        """Take both.

        Args:
            past: the store of past revisions.
            now: the newest run of the tree; None for none. One of a larger or a smaller workspace is left out: all its
                paths are others.
            behind: whether commits are behind the heads of today: others were on another branch, or a forced push took
                them away, and are left out, as are those of other repositories than the newest was made of; None where
                that is not known.
        """
        self._past = past
        kept = past.revisions()
        newest = max(kept, key=lambda one: one.run, default=None)
        self.other_root = ""
        if now is not None and newest is not None and _of_another(now.header, past.view(newest.run).header, newest):
            self.other_root = now.header.root
            now = None
        self._now = now
        self._revisions = tuple(
            one for one in kept if _places(one) == _places(newest or one) and (behind is None or behind(_commits(one)))
        )
        self.left_out = len(kept) - len(self._revisions)

    @cached_property
    def points(self) -> tuple[TrendPoint, ...]:
        """All runs, the earliest first."""
        days = Counter(_form(one.time_s, "%Y-%m-%d") for one in self._revisions)
        tagged = {one.commit: one.name for one in reversed(self.releases)}
        found = [
            TrendPoint(
                one.run, one.commit, one.time_s,
                _moment(one.time_s, days) if one.commits else tagged.get(one.commit, one.commit[:10]),
            )
            for one in self._revisions
        ]  # fmt: skip
        # A tree equal to an existing revision adds nothing.
        if self._now is not None and not any(_is_of(self._now.header, one) for one in self._revisions):
            header = self._now.header
            found.append(TrendPoint(self._now.id, header.commit, _seconds(header.started), "now", now=True))
        return tuple(found)

    @cached_property
    def releases(self) -> tuple[Release, ...]:
        """The releases behind the newest revision, the newest first; of several repositories with their places."""
        if not self._revisions:
            return ()
        several = bool(self._revisions[-1].commits)
        found = [
            msgspec.structs.replace(one, name=f"{reported.path} {one.name}") if several else one
            for reported in self._past.view(self._revisions[-1].run).process
            for one in reported.releases
        ]
        return tuple(sorted(found, key=lambda one: (-one.time_s, one.name)) if several else found)

    @cached_property
    def commits(self) -> tuple[Commits, ...]:
        """The commit of each repository, by its place, at each point."""
        past = {one.run: _commits(one) for one in self._revisions}
        now = self._now.header.commits if self._now is not None else ()
        return tuple(now if one.now else past[one.run] for one in self.points)

    @cached_property
    def views(self) -> tuple[RunView, ...]:
        """The run of each point."""
        now = self._now
        return tuple(now if one.now and now is not None else self._past.view(one.run) for one in self.points)

    @cached_property
    def _packages(self) -> tuple[tuple[PackageSummary, ...], ...]:
        past = self._past.summaries([one.run for one in self.points if not one.now])
        now = self._now.packages() if self._now is not None else ()
        return tuple(now if one.now else past[one.run] for one in self.points)

    @cached_property
    def _repositories(self) -> tuple[dict[str, dict[str, float]], ...]:
        return tuple({one.path: one.values for one in view.process} for view in self.views)

    @cached_property
    def quantities(self) -> Mapping[str, Quantity]:
        """What the two newest runs may have measured, by key: that of the files as they are lacks some of it."""
        return {one.key: one for view in self.views[-2:] for one in view.quantities()}

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """What can be followed, sorted: quantities of packages, of the repository, and counts of findings."""
        found = {key for packages in self._packages for one in packages for key in one.values}
        found.update(key for reported in self._repositories for values in reported.values() for key in values)
        return tuple(sorted(found | COUNTS.keys()))

    @cached_property
    def events(self) -> tuple[TrendEvent, ...]:
        """Releases, packages that moved, and changes of what measures and judges."""
        found = []
        headers = [view.header for view in self.views]
        first: dict[str, int] = {}
        for at, commits in enumerate(self.commits):
            for _, commit in commits:
                first.setdefault(commit, at)
        for release in reversed(self.releases):
            if release.time_s < self.points[0].time_s:
                continue
            place = first.get(release.commit)
            if place is None:
                later = (at for at, point in enumerate(self.points) if at and point.time_s >= release.time_s)
                place = next(later, None)
            if place is not None:
                found.append(TrendEvent(place, "release", release.name))
        for place in range(1, len(headers)):
            found += _changes(place, headers[place - 1], headers[place])
            found += _moves(place, self._packages[place - 1], self._packages[place])
        return tuple(sorted(found, key=lambda one: (one.point, one.kind)))

    def load(self) -> Trends:
        """Read everything now, in the thread that opened the stores, and return the trends."""
        _ = (self._packages, self._repositories, self.events, self.keys)
        return self

    def of(self, key: str) -> Trend:
        """Return the trend of a quantity; one that was not measured has no values."""
        names = {one.id for packages in self._packages for one in packages if one.id != OUTSIDE_PACKAGES}
        columns: dict[str, list[float | None]] = {name: [] for name in sorted(names)}
        whole: list[float | None] = []
        how = self._how(key)
        repositories: dict[str, list[float | None]] = {
            path: [] for path in sorted({path for reported in self._repositories for path in reported})
        }
        for packages, reported in zip(self._packages, self._repositories, strict=True):
            for path, column in repositories.items():
                column.append(reported.get(path, {}).get(key))
            values = {one.id: _value(one, key) for one in packages}
            for name, column in columns.items():
                column.append(values.get(name))
            of_repositories = [found[key] for found in reported.values() if key in found]
            among = of_repositories if how.startswith("repository") else values.values()
            whole.append(_whole(how, [one for one in among if one is not None]))
        base = self.quantities.get(key.partition(".")[0])
        known = {name: tuple(column) for name, column in columns.items() if any(one is not None for one in column)}
        title = COUNTS.get(key) or (base.title if base else key)
        unit = "findings" if key in COUNTS else base.unit if base else ""
        fold = key.partition(".")[2]
        return Trend(
            key, f"{title} ({fold})" if fold else title, unit, how,
            self.points, known, tuple(whole), self.events,
            {
                path: tuple(column)
                for path, column in repositories.items()
                if len(repositories) > 1 and any(one is not None for one in column)
            },
        )  # fmt: skip

    def _how(self, key: str) -> str:
        if any(key in values for reported in self._repositories for values in reported.values()):
            if all(len(reported) <= 1 for reported in self._repositories):
                return "repository"
            return "repository_sum" if key in _OF_REPOSITORIES else "repository_median"
        base = self.quantities.get(key)
        sums = key in COUNTS or key in _SUMS or (base is not None and base.folds[:1] == (Fold.SUM,))
        return "sum" if sums else "median"


def _value(package: PackageSummary, key: str) -> float | None:
    if key in COUNTS:
        wanted = _SEVERITIES.get(key)
        return sum(one.gated for one in package.rules if wanted in (None, one.severity))
    return package.values.get(key)


def _whole(how: str, values: Sequence[float]) -> float | None:
    if not values:
        return None
    return median(values) if how.endswith("median") else sum(values)


def _commits(revision: KeptRevision) -> Commits:
    return revision.commits or ((".", revision.commit),)


def _places(revision: KeptRevision) -> list[str]:
    return [place for place, _ in _commits(revision)]


def _of_another(now: RunHeader, past: RunHeader, revision: KeptRevision) -> bool:
    """Return whether a run is of a folder above or below that of past revisions, and so of other paths.

    Machines that share a store may have the same workspace in different folders: that roots differ says nothing.
    """
    roots = PurePath(now.root), PurePath(past.root)
    if roots[0] != roots[1] and (roots[0].is_relative_to(roots[1]) or roots[1].is_relative_to(roots[0])):
        return True
    places = [place for place, _ in now.commits]
    return bool(places) and (places == ["."]) != (_places(revision) == ["."])


def _is_of(header: RunHeader, revision: KeptRevision) -> bool:
    """Return whether a run of the tree is of this revision, and of no changed file."""
    if not revision.commits:
        return header.commit == revision.commit
    return {*header.commits} == {one for one in revision.commits if one[1]}


def _moment(time_s: int, days: Mapping[str, int]) -> str:
    """Return the day, and the minute where several are of one day."""
    day = _form(time_s, "%Y-%m-%d")
    return day if days[day] == 1 else _form(time_s, "%Y-%m-%d %H:%M")


def _form(time_s: float, form: str) -> str:
    return datetime.fromtimestamp(time_s, tz=timezone.utc).strftime(form)


def _changes(place: int, before: RunHeader, after: RunHeader) -> Iterable[TrendEvent]:
    # Tools that only one side ran are no change of what both measured.
    tools = [
        f"{name} {before.tools[name]} -> {version}"
        for name, version in sorted(after.tools.items())
        if name in before.tools and before.tools[name] != version
    ]
    if tools:
        yield TrendEvent(place, "tools", ", ".join(tools))
    if before.models != after.models:
        yield TrendEvent(place, "models", f"{', '.join(before.models)} -> {', '.join(after.models)}")
    names = sorted(
        name
        for name in before.configuration.keys() | after.configuration.keys()
        if name in {"counting", "macros", "rules", "workspace", "ignore", "gate_roles"}
        and before.configuration.get(name) != after.configuration.get(name)
    )
    if names:
        yield TrendEvent(place, "settings", ", ".join(names))


def _moves(place: int, before: Sequence[PackageSummary], after: Sequence[PackageSummary]) -> Iterable[TrendEvent]:
    """Yield one event for all packages that are in another folder, maybe of another repository."""
    old = {one.id: one.path for one in before if one.id != OUTSIDE_PACKAGES}
    moved = [f"{one.id}: {old[one.id]} -> {one.path}" for one in after if old.get(one.id, one.path) != one.path]
    if moved:
        more = f" and {len(moved) - _MOST_MOVED} more" if len(moved) > _MOST_MOVED else ""
        yield TrendEvent(place, "moved", ", ".join(moved[:_MOST_MOVED]) + more)


def _seconds(started: str) -> float:
    try:
        return datetime.fromisoformat(started).timestamp()
    except ValueError:
        return 0.0
