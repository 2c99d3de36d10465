"""What a name of a run means: a kept run, the newest one, or a revision, which is analysed if need be."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.git.git_repository import commit_of_revision, names_like, repository_of
from roslens.cli.past.past_runs import PastRuns, past_runs
from roslens.cli.workplace.process_option import seconds_of
from roslens.cli.workplace.shared_store import shared_address
from roslens.cli.workplace.workplace import STORE, kept_in, open_store
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.source.history.past_states import PastState
    from roslens.source.settings import SourceSettings
    from roslens.store.read import RunView
    from roslens.store.runs import Store

_DAY_S = 86_400

NOW = ("now", "last")
RELEASE = "release"


class NamedRun(msgspec.Struct, frozen=True):
    """A run and what it is called, with the commit of each repository by its place, as far as that is known."""

    title: str
    view: RunView
    commits: tuple[tuple[str, str], ...]

    @property
    def commit(self) -> str:
        """The commit of the only repository; of several what their commits are known by, empty where none is known."""
        return self.view.header.commit


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
            newest = past.states.newest_release()
            if newest is None:
                raise UsageError(f'"{RELEASE}": the repository has no release', expected="a tag such as v1.2.3")
            return self._of_state(*newest)
        if not self._past_runs().states.is_one:
            return self._of_several(name)
        repository = repository_of(str(self.root))
        commit = commit_of_revision(repository, name)
        if not commit:
            near = names_like(repository, name)
            raise UsageError(
                f'"{name}" is not a run: git knows no such revision',
                expected="a number of a kept run, `now`, `release`, or a branch, tag or commit",
                advice=f"Did you mean {', '.join(near)}?" if near else "",
            )
        state = self._past_runs().states.of_commit(commit)
        if state is None:
            raise UsageError(
                f'revision "{name}" is not behind the head', expected="one that the work tree comes from",
                advice="Check out a branch that has it",
            )  # fmt: skip
        return self._of_state(name, state)

    def _of_tree(self, name: str) -> NamedRun:
        if self._store is None:
            if not (kept_in(self.root) / STORE).is_file() and not shared_address(str(self.root)):
                raise UsageError(
                    f'"{name}": nothing was checked in {self.root} yet', expected="a kept run",
                    advice="Run `roslens check` first",
                )  # fmt: skip
            self._store = self._opened.enter_context(open_store(str(self.root)))
        view = self._store.view(None if name in NOW else int(name))
        return NamedRun(_title(name, view), view, view.header.commits)

    def _of_several(self, name: str) -> NamedRun:
        """Return how several repositories stood on a day, at its end, or at a time."""
        states = self._past_runs().states
        try:
            time_s = seconds_of(name) + (_DAY_S - 1 if re.fullmatch(r"\d{4}-\d{2}-\d{2}", name) else 0)
        except UsageError:
            raise UsageError(
                f'"{name}" is not a run: the workspace holds {len(states.repositories)} repositories, '
                "and a revision is of one of them",
                expected="a number of a kept run, `now`, `release`, or a date such as 2024-01-31",
            ) from None
        state = states.at(time_s)
        if not any(commit for _, commit in state.commits):
            raise UsageError(f'"{name}" is before the first commit of all repositories', expected="a later date")
        return self._of_state(name, state)

    def _of_state(self, name: str, state: PastState) -> NamedRun:
        title = name if state.id.startswith(name) else f"{name} ({state.id[:10]})"
        past = self._past_runs()
        return NamedRun(title, past.store.view(past.run_of(state).run), state.commits)

    def _past_runs(self) -> PastRuns:
        if self._past is None:
            self._past = self._opened.enter_context(past_runs(self.root, self._settings))
        return self._past


@contextmanager
def named_runs(root: Path, settings: SourceSettings) -> Iterator[NamedRuns]:
    """Open what finds runs of the workspace at ``root`` by name."""
    with ExitStack() as opened:
        yield NamedRuns(root, settings, opened)


def _title(name: str, view: RunView) -> str:
    """Return what a run of a work tree is called: by what was asked for, and by what it is a run of."""
    header = view.header
    if commit := header.commit:
        of = f" of {commit[:10]}{'+' if commit.endswith('+') else ''}"
    elif len(header.repositories) > 1:
        of = f" of {len(header.repositories)} repositories"
    else:
        of = ""
    run = f"run {view.id}{of}"
    return f"{name} ({run}, {header.started[:10]})" if name in NOW else run
