"""The histories of all repositories of a workspace, as a part of a run."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress

import msgspec

from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.process import RepositoryProcess
from roslens.model.source import OUTSIDE_PACKAGES, SourceFile
from roslens.source.forge.ask_forges import ForgeAnswers
from roslens.source.history.commit_log import CommitLog
from roslens.source.history.git_answer import LACKS_OBJECTS, HistoryError
from roslens.source.history.measure_history import measure_history
from roslens.source.history.read_log import read_log
from roslens.source.history.repository_head import RepositoryHead, head_of, tops_of
from roslens.source.keys import analyser_version, key_of
from roslens.source.workspace.find import Workspace
from roslens.store.cache import Cache

ReadLog = Callable[[RepositoryHead], CommitLog]


class Histories(msgspec.Struct, frozen=True):
    """Repositories whose history can be determined, and what is reported of the others.

    Attributes:
        root: of the workspace.
        heads: of these repositories.
        failures: what cannot be determined, and why.
        as_of_s: the time at which ages are taken, in seconds since 1970; None for that of each head.
        forge: what forges reported, where they were asked.
    """

    root: str
    heads: tuple[RepositoryHead, ...]
    failures: tuple[Failure, ...]
    as_of_s: float | None = None
    forge: ForgeAnswers | None = None

    @property
    def key(self) -> str:
        """A key of all that shapes what is reported."""
        return key_of([one for head in self.heads for one in _shaping(head)], self.failures, self.as_of_s, self.forge)

    def measure(
        self,
        packages: Mapping[str, str],
        files: Mapping[str, Sequence[SourceFile]],
        complexity: Mapping[str, float],
        read: ReadLog,
    ) -> tuple[tuple[RepositoryProcess, ...], tuple[Failure, ...]]:
        """Return what the histories say, and what of it could not be determined.

        Args:
            packages: folder of each package below the root of the workspace.
            files: of each package.
            complexity: of all functions of a file together, by path.
            read: gives the log of a repository.
        """
        found, failures = [], []
        for head in self.heads:
            path = place_of(self.root, head.top)
            try:
                log = read(head)
            except HistoryError as error:
                failures.append(unreadable(path, str(error)))
                continue
            if not log.has_lines:
                failures.append(without_contents(path, has_changes=log.has_changes))
            known = {commit.id for commit in log.commits}
            one = measure_history(
                log,
                [one for one in head.releases if one.commit in known],
                path=path,
                packages=self._packages(head.top, packages),
                files=self._files(head.top, files),
                complexity=complexity,
                as_of_s=self.as_of_s,
            )
            if self.forge is not None and (reported := self.forge.counts.get(head.top)) is not None:
                one = msgspec.structs.replace(one, values={**one.values, **reported.values()})
            found.append(one)
        return tuple(found), tuple(failures)

    def _packages(self, top: str, packages: Mapping[str, str]) -> dict[str, str]:
        inside = {one: self._inside(top, path) for one, path in packages.items() if one != OUTSIDE_PACKAGES}
        return {one: path for one, path in inside.items() if path is not None}

    def _files(self, top: str, files: Mapping[str, Sequence[SourceFile]]) -> dict[str, str]:
        paths = (file.path for held in files.values() for file in held)
        return {inside: path for path in paths if (inside := self._inside(top, path)) is not None}

    def _inside(self, top: str, path: str) -> str | None:
        """Return the path below the root of a repository of one below the root of the workspace."""
        whole = os.path.normpath(f"{self.root}/{path}")
        if whole == top:
            return "."
        return whole[len(top) + 1 :] if whole.startswith(f"{top}/") else None


AskForges = Callable[[Sequence[tuple[str, str]]], ForgeAnswers]


def histories_of(workspace: Workspace, *, as_of_s: float | None = None, ask: AskForges | None = None) -> Histories:
    """Return the repositories that the packages of a workspace are in; what is in none has no history.

    Args:
        workspace: with its packages.
        as_of_s: the time at which ages are taken, in seconds since 1970; None for that of each head.
        ask: asks forges for repositories, by folder and place below the root; None asks nobody.
    """
    folders = (found.folder for found in workspace.packages)
    heads, failures = [], []
    for top in tops_of(str(folder) for folder in folders):
        path = place_of(workspace.root, top)
        try:
            head = head_of(top)
        except HistoryError as error:
            failures.append(unreadable(path, str(error)))
            continue
        if not head.head:
            failures.append(
                _unreported(path, f'repository "{path}" has no commit yet', "a history", "Commit something")
            )
        elif head.is_shallow:
            failures.append(_shallow(path))
        else:
            heads.append(head)
    reported = ask([(head.top, place_of(workspace.root, head.top)) for head in heads]) if ask is not None else None
    return Histories(
        workspace.root, tuple(heads), (*failures, *(reported.failures if reported else ())), as_of_s, reported
    )


def log_reader(cache: Cache) -> ReadLog:
    """Return what reads a log, and keeps it under the commit: a commit always has the same commits behind it."""
    decode = msgspec.msgpack.Decoder(CommitLog).decode

    def read(head: RepositoryHead) -> CommitLog:
        key = f"log:{key_of(*_shaping_log(head))}"
        kept = cache.get([key]).get(key)
        if kept is not None:
            with suppress(msgspec.DecodeError):
                cache.touch([key])
                return decode(kept)
        log = _read(head)
        cache.put({key: msgspec.msgpack.encode(log)})
        return log

    return read


def _read(head: RepositoryHead) -> CommitLog:
    try:
        return read_log(head.top, head.head)
    except HistoryError:
        # Objects are missing: the clone is a partial one, or it was cut off or damaged.
        return read_log(head.top, head.head, contents=False)


def _shaping_log(head: RepositoryHead) -> tuple[object, ...]:
    return analyser_version(), head.head, head.is_partial, head.mailmap, head.attributes


def _shaping(head: RepositoryHead) -> tuple[object, ...]:
    return (*_shaping_log(head), head.top, head.releases)


def place_of(root: str, top: str) -> str:
    """Return where a repository is below the root of a workspace; ``.`` where the workspace is in it."""
    return os.path.relpath(top, root) if top.startswith(f"{root}/") else "."


def unreadable(path: str, said: str) -> Failure:
    """Return the failure of a repository whose history git cannot read."""
    return _unreported(
        path,
        f'the history of repository "{path}" cannot be read: {said}',
        "a repository that git can read",
        "Check it with `git log`; if another user owns it, `git config --global --add safe.directory` names it",
    )


def without_contents(path: str, *, has_changes: bool) -> Failure:
    """Return the failure of a clone in which objects are missing."""
    lacks = "churn and hotspots" if has_changes else "process metrics of packages and files"
    return _unreported(
        path,
        f'repository "{path}" lacks objects of its history, as a partial clone does: {lacks} are not known',
        "a clone with all objects",
        LACKS_OBJECTS,
    )


def _shallow(path: str) -> Failure:
    return _unreported(
        path,
        f'repository "{path}" is a shallow clone: its older commits are missing, so no process metric is reported',
        "a clone with all commits",
        "git fetch --unshallow (in GitHub's workflows: actions/checkout with fetch-depth: 0)",
    )


def _unreported(path: str, what: str, expected: str, advice: str) -> Failure:
    entity = str(EntityId(EntityKind.REPOSITORY, path))
    return Failure("history", what, expected, advice, entity=entity, partial=True)
