"""Runs of past revisions of a workspace: made from git's objects, kept beside the runs of today."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.git_repository import Repository, repository_of
from roslens.cli.past_store import open_past
from roslens.cli.process_option import seconds_of
from roslens.cli.workplace import CACHE, own_folder
from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.model.process import Release

if TYPE_CHECKING:
    from roslens.source.history.commit_log import Commit, CommitLog
    from roslens.source.history.histories import ReadLog
    from roslens.source.history.past_cache import PastCache
    from roslens.source.history.past_tree import PastTree
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
        self, root: Path, repository: Repository, settings: SourceSettings, store: Store, cache: PastCache,
        tree: PastTree, history: tuple[CommitLog, tuple[Release, ...]],
    ) -> None:  # fmt: skip
        """Use :func:`past_runs`."""
        from roslens.source.history.parts_of_commits import PartsOfCommits
        from roslens.source.keys import analyser_version, key_of
        from roslens.source.remembered_facts import RememberedFacts

        self.root = root
        self.repository = repository
        self.store = store
        self.log, self.released = history
        self._settings = settings
        self._cache = cache
        self._tree = tree
        self._remembered = RememberedFacts()
        self._parts = PartsOfCommits(self.log)
        self._key = key_of(analyser_version(), settings)
        self._known = {one.commit: one.run for one in store.revisions() if one.key == self._key}

    def commit(self, name: str) -> Commit | None:
        """Return the commit behind the head with this hash."""
        return next((one for one in self.log.commits if one.id == name), None)

    def run_of(self, commit: Commit) -> MadeRun:
        """Return the run of a commit, made if there is none of these settings.

        Raises:
            RoslensError: git does not have the revision, or the store cannot be written.
        """
        from roslens.source.history.git_answer import HistoryError
        from roslens.store.revisions import KeptRevision

        if (known := self._known.get(commit.id)) is not None:
            return MadeRun(known, fresh=False, seconds=0.0)
        begun = time.monotonic()
        try:
            self._cache.forget(self._tree.show(commit.id))
        except HistoryError as error:
            raise UsageError(
                f'git cannot give the files of revision "{commit.id[:12]}": {error}',
                expected="a repository that has them",
                advice="In a partial clone, check the revision out once, so that git fetches them",
            ) from error
        run = self._analysed(commit, begun)
        self.store.mark_revision(KeptRevision(run, commit.id, self._key, commit.time_s))
        self._known[commit.id] = run
        return MadeRun(run, fresh=True, seconds=time.monotonic() - begun)

    def _analysed(self, commit: Commit, begun: float) -> int:
        from datetime import datetime, timezone

        from roslens.source.history.past_of_commit import PastOfCommit
        from roslens.source.history.past_revision import PastRevision
        from roslens.source.pipeline import Clock, analyse

        now = time.time()
        past = PastOfCommit(self.log, commit.id, self.released, self.repository.below, self._lacking(), self._parts)
        return analyse(
            [self._tree.folder],
            self._settings,
            store=self.store,
            cache=self._cache,
            clock=Clock(
                datetime.fromtimestamp(now, tz=timezone.utc).isoformat(timespec="seconds"),
                now,
                lambda: time.monotonic() - begun,
            ),
            base=self._tree.folder,
            jobs=1,
            look_back=lambda _workspace, _cache: past,
            revision=PastRevision(str(self.root), commit.id, self._remembered),
            kept_runs=None,
        ).run

    def _lacking(self) -> tuple[Failure, ...]:
        """Return what of the revision on disk is not there."""
        found = []
        if self._tree.lacking:
            found.append(
                Failure(
                    "history",
                    f'git lacks {len(self._tree.lacking)} files of the revision, such as "{self._tree.lacking[0]}"',
                    "a clone with all objects",
                    "Fetch them: git fetch --refetch --no-filter",
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
    from roslens.source.history.past_tree import PastTree
    from roslens.source.settings import ToolSettings

    repository = repository_of(str(root))
    settings = msgspec.structs.replace(
        settings, tools=ToolSettings(), plugins=(), untrusted=(), options={}, models=_models(settings.models, root)
    )
    folder = own_folder(root)
    with (
        TemporaryDirectory(prefix="roslens-past-") as place,
        open_past(root) as store,
        PastCache.open(folder / CACHE) as cache,
        PastTree(repository.root, repository.below, Path(place).resolve()) as tree,
    ):
        assert isinstance(cache, PastCache)  # noqa: S101 - only for the type checker
        history = _history(repository, log_reader(cache))
        yield PastRuns(root, repository, settings, store, cache, tree, history)


def _models(names: Sequence[str], root: Path) -> tuple[str, ...]:
    """Return models as they are found from any folder: those of files by their whole path."""
    return tuple(str((root / name).resolve()) if (root / name).is_file() else name for name in names)


def _history(repository: Repository, read: ReadLog) -> tuple[CommitLog, tuple[Release, ...]]:
    from roslens.source.history.git_answer import HistoryError
    from roslens.source.history.repository_head import head_of

    try:
        head = head_of(repository.root)
        if not head.head:
            raise UsageError(f"{repository.root} has no commit yet", expected="a history", advice="Commit something")
        if head.is_shallow:
            raise UsageError(
                f"{repository.root} is a shallow clone: its older commits are missing",
                expected="a clone with all commits",
                advice="git fetch --unshallow",
            )
        log = read(head)
    except HistoryError as error:
        raise UsageError(
            f"the history of {repository.root} cannot be read: {error}", expected="a repository that git can read"
        ) from error
    known = {commit.id for commit in log.commits}
    return log, tuple(one for one in head.releases if one.commit in known)


def since_of(text: str | None, runs: PastRuns) -> float | None:
    """Return the time that ``--since`` means: a date, or that of a revision.

    Raises:
        UsageError: it is neither.
    """
    from roslens.cli.git_repository import commit_of_revision

    if text is None:
        return None
    if (name := commit_of_revision(runs.repository, text)) and (commit := runs.commit(name)) is not None:
        return float(commit.time_s)
    try:
        return seconds_of(text)
    except UsageError:
        raise UsageError(
            f"--since {text!r}", expected="a date such as 2024-01-31, or a revision behind the head"
        ) from None
