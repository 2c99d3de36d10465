"""Runs of past revisions of a workspace: made from git's objects, kept beside the runs of today."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.children.scratch_folder import ScratchFolder
from roslens.cli.past.past_repositories import past_repositories
from roslens.cli.past.past_store import open_past
from roslens.cli.workplace.process_option import seconds_of
from roslens.cli.workplace.workplace import CACHE, own_folder
from roslens.model.errors import UsageError
from roslens.model.failure import Failure

if TYPE_CHECKING:
    from roslens.source.history.past_cache import PastCache
    from roslens.source.history.past_of_state import PastOfState
    from roslens.source.history.past_states import PastState, PastStates
    from roslens.source.history.past_trees import PastTrees
    from roslens.source.settings import SourceSettings
    from roslens.store.runs import Store


class MadeRun(msgspec.Struct, frozen=True):
    """The run of a revision, whether it was made now, and how long that took."""

    run: int
    fresh: bool
    seconds: float


class PastRuns:
    """Makes runs of past revisions, one after the other; see :func:`past_runs`."""

    def __init__(
        self, root: Path, settings: SourceSettings, store: Store, cache: PastCache, trees: PastTrees, states: PastStates
    ) -> None:
        """Use :func:`past_runs`."""
        from roslens.source.fetch.fetched_set import read_fetched_set
        from roslens.source.history.parts_of_commits import PartsOfCommits
        from roslens.source.keys import analyser_version, key_of
        from roslens.source.measure.remembered_facts import RememberedFacts

        self.root = root
        self.store = store
        self.states = states
        self._settings = settings
        self._cache = cache
        self._trees = trees
        self._remembered = RememberedFacts()
        self._parts = {one.place: PartsOfCommits(one.log) for one in states.repositories}
        wanted = [(path, *sorted(names)) for path, names in sorted(read_fetched_set(str(root)).wanted.items())]
        self._key = key_of(analyser_version(), settings, *wanted)
        self._known = {one.commit: one.run for one in store.revisions() if one.key == self._key}

    def run_of(self, state: PastState) -> MadeRun:
        """Return the run of a state, made if there is none of these settings.

        Raises:
            RoslensError: git does not have the revision, or the store cannot be written.
        """
        from roslens.source.history.git_answer import LACKS_OBJECTS, HistoryError
        from roslens.store.revisions import KeptRevision

        if (known := self._known.get(state.id)) is not None:
            return MadeRun(known, fresh=False, seconds=0.0)
        begun = time.monotonic()
        try:
            self._cache.forget(self._trees.show(state))
        except HistoryError as error:
            raise UsageError(
                f'git cannot give the files of revision "{state.id[:12]}": {error}',
                expected="a repository that has them",
                advice=LACKS_OBJECTS,
            ) from error
        run = self._analysed(state, begun)
        commits = () if self.states.is_one else state.commits
        self.store.mark_revision(KeptRevision(run, state.id, self._key, state.time_s, commits))
        self._known[state.id] = run
        return MadeRun(run, fresh=True, seconds=time.monotonic() - begun)

    def _analysed(self, state: PastState, begun: float) -> int:
        from datetime import datetime, timezone

        from roslens.source.history.past_revision import PastRevision
        from roslens.source.pipeline import Clock, analyse

        now = time.time()
        past = self._past(state)
        return analyse(
            [self._trees.folder],
            self._settings,
            store=self.store,
            cache=self._cache,
            clock=Clock(
                datetime.fromtimestamp(now, tz=timezone.utc).isoformat(timespec="seconds"),
                now,
                lambda: time.monotonic() - begun,
            ),
            base=self._trees.folder,
            jobs=1,
            look_back=lambda _workspace, _cache: past,
            revision=PastRevision(str(self.root), state.id, self._remembered),
            kept_runs=None,
        ).run

    def _past(self, state: PastState) -> PastOfState:
        from roslens.source.history.past_of_commit import PastOfCommit
        from roslens.source.history.past_of_state import PastOfState

        commits = dict(state.commits)
        return PastOfState(
            tuple(
                PastOfCommit(one.log, commits[one.place], one.released, one.place, one.below, self._parts[one.place])
                for one in self.states.repositories
                if commits[one.place]
            ),
            self._lacking(),
        )

    def _lacking(self) -> tuple[Failure, ...]:
        """Return what of the revision on disk is not there."""
        from roslens.source.history.git_answer import LACKS_OBJECTS

        found = []
        if self._trees.lacking:
            found.append(
                Failure(
                    "history",
                    f'git lacks {len(self._trees.lacking)} files of the revision, such as "{self._trees.lacking[0]}"',
                    "a clone with all objects",
                    LACKS_OBJECTS,
                    partial=True,
                )
            )
        return tuple(found)


@contextmanager
def past_runs(root: Path, settings: SourceSettings) -> Iterator[PastRuns]:
    """Open what makes and keeps runs of past revisions of the workspace at ``root``.

    Foreign tools, plug-ins and computation graphs are left out: runs of all revisions are made alike, and quickly.

    Raises:
        RoslensError: it is in no repository with commits, or one that cannot be read; or the store cannot be opened.
    """
    from roslens.source.history.histories import log_reader
    from roslens.source.history.past_cache import PastCache
    from roslens.source.history.past_states import PastStates
    from roslens.source.history.past_trees import PastTrees
    from roslens.source.settings import ToolSettings

    settings = msgspec.structs.replace(
        settings, tools=ToolSettings(), plugins=(), untrusted=(), options={}, models=_models(settings.models, root)
    )
    folder = own_folder(root)
    with PastCache.open(folder / CACHE) as cache:
        assert isinstance(cache, PastCache)  # noqa: S101 - only for the type checker
        states = PastStates(past_repositories(root, settings.workspace, log_reader(cache)))
        with (
            ScratchFolder("past") as place,
            open_past(root) as store,
            PastTrees(states.repositories, Path(place).resolve()) as trees,
        ):
            yield PastRuns(root, settings, store, cache, trees, states)


def _models(names: Sequence[str], root: Path) -> tuple[str, ...]:
    """Return models as they are found from any folder: those of files by their whole path."""
    return tuple(str((root / name).resolve()) if (root / name).is_file() else name for name in names)


def since_of(text: str | None, states: PastStates) -> float | None:
    """Return the time that ``--since`` means: a date, or that of a revision of the only repository.

    Raises:
        UsageError: it is neither.
    """
    from roslens.cli.git.git_repository import commit_of_revision, repository_of

    if text is None:
        return None
    if states.is_one:
        name = commit_of_revision(repository_of(states.repositories[0].top), text)
        if (state := states.of_commit(name)) is not None:
            return float(state.time_s)
    try:
        return seconds_of(text)
    except UsageError:
        expected = "a date such as 2024-01-31, or a revision behind the head"
        if not states.is_one:
            expected = "a date such as 2024-01-31, as revisions are of one of the repositories"
        raise UsageError(f"--since {text!r}", expected=expected) from None
