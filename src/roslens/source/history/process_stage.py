"""Process metrics in a run: who tells them, and what a run has to give for it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple, Protocol

import msgspec

from roslens.model.failure import Failure
from roslens.model.process import RepositoryProcess
from roslens.model.result import WorkspaceResult
from roslens.model.source import SourceFile
from roslens.source.history.histories import AskForges, Histories, histories_of, log_reader
from roslens.source.history.judged_process import BOUNDABLE
from roslens.source.workspace.find import Workspace
from roslens.store.cache import Cache


class Past(Protocol):
    """The histories of a workspace's repositories."""

    @property
    def key(self) -> str:
        """A key of all that shapes what they say."""

    @property
    def failures(self) -> tuple[Failure, ...]:
        """What is known from the start that they cannot say."""

    def tell(
        self,
        packages: Mapping[str, str],
        files: Mapping[str, Sequence[SourceFile]],
        complexity: Mapping[str, float],
    ) -> tuple[tuple[RepositoryProcess, ...], tuple[Failure, ...]]:
        """Return what they say of the packages, by folder, and files; and what could not be determined."""


LookBack = Callable[[Workspace, Cache], Past]


class PastOfWorkspace(msgspec.Struct, frozen=True):
    """The histories of the repositories that a workspace lies in or holds."""

    histories: Histories
    cache: Cache

    @property
    def key(self) -> str:
        """A key of all that shapes what they say."""
        return self.histories.key

    @property
    def failures(self) -> tuple[Failure, ...]:
        """What is known from the start that they cannot say."""
        return self.histories.failures

    def tell(
        self,
        packages: Mapping[str, str],
        files: Mapping[str, Sequence[SourceFile]],
        complexity: Mapping[str, float],
    ) -> tuple[tuple[RepositoryProcess, ...], tuple[Failure, ...]]:
        """Return what they say, and what could not be determined."""
        return self.histories.measure(packages, files, complexity, log_reader(self.cache))


class Reported(NamedTuple):
    """What histories say of a run, and what they cannot say."""

    process: tuple[RepositoryProcess, ...]
    failures: tuple[Failure, ...]


def with_process(whole: WorkspaceResult, reported: Reported) -> WorkspaceResult:
    """Return the result with process metrics."""
    values = {package: dict(known) for package, known in whole.package_values.items()}
    for one in reported.process:
        for package, known in one.packages.items():
            values.setdefault(package, {}).update(known)
    return msgspec.structs.replace(
        whole,
        package_values=values,
        failures=(*whole.failures, *reported.failures),
        quantities=(*whole.quantities, *BOUNDABLE.values()),
        process=reported.process,
    )


def look_back(as_of_s: float | None, ask: AskForges | None = None) -> LookBack:
    """Return what looks at the histories of a workspace as it stands, and asks forges where that is wanted."""
    return lambda workspace, cache: PastOfWorkspace(histories_of(workspace, as_of_s=as_of_s, ask=ask), cache)
