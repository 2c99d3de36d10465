"""What a name of a run means: a kept run, the newest one, or a revision, which is analysed if need be."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.git_repository import commit_of_revision, names_like, repository_of
from roslens.cli.past_runs import PastRuns, past_runs
from roslens.cli.shared_store import shared_address
from roslens.cli.workplace import FOLDER, STORE, open_store
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.source.settings import SourceSettings
    from roslens.store.read import RunView
    from roslens.store.runs import Store

NOW = ("now", "last")
RELEASE = "release"


class NamedRun(msgspec.Struct, frozen=True):
    """A run and what it is called; ``commit`` is empty where it is not known."""

    title: str
    view: RunView
    commit: str


class NamedRuns:
    """Finds runs by name; see :func:`named_runs`."""

    def __init__(self, root: Path, settings: SourceSettings, opened: ExitStack) -> None:
        """Use :func:`named_runs`."""
        self.root = root
        self._settings = settings
        self._opened = opened
        self._store: Store | None = None
        self._past: PastRuns | None = None
        self._kept: Store | None = None

    def find(self, name: str) -> NamedRun:
        """Return the run that a name means.

        Raises:
            RoslensError: it means none, or the revision cannot be analysed.
        """
        if name in NOW or name.isdigit():
            return self._of_tree(name)
        if name == RELEASE:
            past = self._past_runs()
            newest = max(past.released, key=lambda one: one.time_s, default=None)
            if newest is None:
                raise UsageError(f'"{RELEASE}": the repository has no release', expected="a tag such as v1.2.3")
            return self._of_commit(newest.commit, newest.name)
        repository = repository_of(str(self.root))
        commit = commit_of_revision(repository, name)
        if not commit:
            near = names_like(repository, name)
            raise UsageError(
                f'"{name}" is no run: git knows no such revision',
                expected="a number of a kept run, `now`, `release`, or a branch, tag or commit",
                advice=f"Did you mean {', '.join(near)}?" if near else "",
            )
        return self._of_commit(commit, name)

    def _of_tree(self, name: str) -> NamedRun:
        if self._store is None:
            if not (self.root / FOLDER / STORE).is_file() and not shared_address(str(self.root)):
                raise UsageError(
                    f'"{name}": nothing was checked in {self.root} yet', expected="a kept run",
                    advice="Run `roslens check` first",
                )  # fmt: skip
            self._store = self._opened.enter_context(open_store(str(self.root)))
        view = self._store.view(None if name in NOW else int(name))
        commit = view.header.commit
        at = f" of {commit[:10]}{'+' if commit.endswith('+') else ''}" if commit else ""
        return NamedRun(f"run {view.id}{at}", view, commit)

    def _of_commit(self, commit: str, name: str) -> NamedRun:
        title = name if commit.startswith(name) else f"{name} ({commit[:10]})"
        past = self._past_runs()
        found = past.commit(commit)
        if found is None:
            raise UsageError(
                f'revision "{name}" is not behind the head', expected="one that the work tree comes from",
                advice="Check out a branch that has it",
            )  # fmt: skip
        return NamedRun(title, past.store.view(past.run_of(found).run), commit)

    def _past_runs(self) -> PastRuns:
        if self._past is None:
            self._past = self._opened.enter_context(past_runs(self.root, self._settings))
        return self._past


@contextmanager
def named_runs(root: Path, settings: SourceSettings) -> Iterator[NamedRuns]:
    """Open what finds runs of the workspace at ``root`` by name."""
    with ExitStack() as opened:
        yield NamedRuns(root, settings, opened)
