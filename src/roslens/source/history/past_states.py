"""How the repositories of a workspace stood together, at times in the past."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence

import msgspec

from roslens.model.process import Release
from roslens.source.history.chosen_revisions import FORMS, Every, chosen_revisions, last_of_each, main_line
from roslens.source.history.commit_log import Commit, CommitLog


class RepositoryPast(msgspec.Struct, frozen=True):
    """A repository of a workspace and what is behind its head.

    Attributes:
        place: of it below the root of the workspace; ``.`` where the workspace lies in it.
        top: folder of its work tree.
        below: the folder in it that is looked at; empty or ending with ``/``.
        log: of the head, which has at least one commit.
        released: releases behind the head.
    """

    place: str
    top: str
    below: str
    log: CommitLog
    released: tuple[Release, ...]


class PastState(msgspec.Struct, frozen=True):
    """Where each repository stood.

    Attributes:
        id: the commit where the workspace lies in one repository; else a hash of all commits.
        time_s: in seconds since 1970.
        commits: by place of the repository; empty where it had none by then.
    """

    id: str
    time_s: int
    commits: tuple[tuple[str, str], ...]


class PastStates:
    """The states that a workspace went through."""

    def __init__(self, repositories: Sequence[RepositoryPast]) -> None:
        """Take one repository with the place ``.``, or any number of others."""
        self.repositories = tuple(repositories)
        self._lines = {one.place: main_line(one.log) for one in repositories}
        self._times = {one.place: {commit.id: commit.time_s for commit in one.log.commits} for one in repositories}

    @property
    def is_one(self) -> bool:
        """Whether the workspace lies in one repository, whose commits are the states."""
        return [one.place for one in self.repositories] == ["."]

    def chosen(self, every: Every, *, since_s: float | None = None) -> list[PastState]:
        """Return the states to look at, the oldest first; the last is that of the heads.

        Of several repositories, a state is what the newest commits on their main lines were at the time of a release
        of any of them, of the last commit of a period, or of each so-manieth commit of all main lines together.

        Args:
            every: how often.
            since_s: without states before this time, in seconds since 1970.
        """
        if self.is_one:
            (only,) = self.repositories
            return [
                self._of_one(commit) for commit in chosen_revisions(only.log, only.released, every, since_s=since_s)
            ]
        found = {one.id: one for one in self._of_several(every)}
        return sorted((one for one in found.values() if since_s is None or one.time_s >= since_s), key=_in_time)

    def of_commit(self, name: str) -> PastState | None:
        """Return the state of a commit of the only repository; None where that is not behind its head."""
        if not self.is_one or name not in self._times["."]:
            return None
        return PastState(name, self._times["."][name], ((".", name),))

    def at(self, time_s: float, pinned: Mapping[str, str] | None = None) -> PastState:
        """Return how the repositories stood at a time.

        Args:
            time_s: in seconds since 1970.
            pinned: commits of some of them, by place, which then stood there.
        """
        commits = []
        latest = 0
        for one in self.repositories:
            name = (pinned or {}).get(one.place) or next(
                (commit.id for commit in self._lines[one.place] if commit.time_s <= time_s), ""
            )
            commits.append((one.place, name))
            latest = max(latest, self._times[one.place].get(name, 0))
        if self.is_one:
            return PastState(commits[0][1], latest, tuple(commits))
        text = "\n".join(f"{name} {place}" for place, name in commits)
        return PastState(hashlib.sha1(text.encode(), usedforsecurity=False).hexdigest(), latest, tuple(commits))

    def newest_release(self) -> tuple[str, PastState] | None:
        """Return the name and the state of the newest release of any repository; None where there is none."""
        released = [(one.time_s, one.name, place.place, one) for place in self.repositories for one in place.released]
        if not released:
            return None
        _, name, place, release = max(released, key=lambda one: one[:3])
        return name if self.is_one else f"{place} {name}", self.at(release.time_s, {place: release.commit})

    def _of_one(self, commit: Commit) -> PastState:
        return PastState(commit.id, commit.time_s, ((".", commit.id),))

    def _of_several(self, every: Every) -> Iterator[PastState]:
        newest_first = sorted(
            (commit for line in self._lines.values() for commit in line), key=lambda one: one.time_s, reverse=True
        )
        if newest_first:
            yield self.at(newest_first[0].time_s, {place: line[0].id for place, line in self._lines.items()})
        if every.period == "release":
            for repository in self.repositories:
                for release in repository.released:
                    yield self.at(release.time_s, {repository.place: release.commit})
            return
        chosen = (
            newest_first[:: every.step] if every.period is None else last_of_each(newest_first, FORMS[every.period])
        )
        for commit in chosen:
            yield self.at(commit.time_s)


def _in_time(state: PastState) -> tuple[int, str]:
    return state.time_s, state.id
