"""What history said when a past commit was the head."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.failure import Failure
from roslens.model.process import Release, RepositoryProcess
from roslens.model.source import OUTSIDE_PACKAGES, SourceFile
from roslens.source.history.commit_log import CommitLog, behind
from roslens.source.history.histories import without_contents
from roslens.source.history.measure_history import measure_history
from roslens.source.history.parts_of_commits import PartsOfCommits
from roslens.source.keys import key_of


class PastOfCommit(msgspec.Struct, frozen=True):
    """The history behind one commit, of its repository and packages; files have theirs in a run of the head.

    Attributes:
        log: of a later head that has the commit behind it.
        commit: that is looked at.
        released: releases behind the later head.
        place: of the repository below the root of the workspace; ``.`` where the workspace lies in it.
        below: the folder of the repository that is looked at; empty or ending with ``/``.
        parts: of the commits of the log, which all revisions share.
    """

    log: CommitLog
    commit: str
    released: tuple[Release, ...]
    place: str = "."
    below: str = ""
    parts: PartsOfCommits | None = None

    @property
    def key(self) -> str:
        """A key of all that shapes what is reported."""
        return key_of(self.place, self.commit, self.released)

    def tell(
        self,
        packages: Mapping[str, str],
        files: Mapping[str, Sequence[SourceFile]],  # noqa: ARG002 - the shape of every past
        complexity: Mapping[str, float],
    ) -> tuple[tuple[RepositoryProcess, ...], tuple[Failure, ...]]:
        """Return what the history says, and what it cannot say."""
        then = behind(self.log, self.commit)
        known = {commit.id for commit in then.commits}
        folders = self._folders(packages)
        found = measure_history(
            then, [one for one in self.released if one.commit in known], path=self.place, packages=folders, files={},
            complexity=complexity, parts=self.parts,
        )  # fmt: skip
        lacking = () if then.has_lines else (without_contents(self.place, has_changes=then.has_changes),)
        return (found,), lacking

    def _folders(self, packages: Mapping[str, str]) -> dict[str, str]:
        """Return the folder of each package of the repository, below its root."""
        inside = {one: path for one, path in packages.items() if one != OUTSIDE_PACKAGES}
        if self.place == ".":
            return {
                one: f"{self.below}{path}" if path != "." else self.below.rstrip("/") for one, path in inside.items()
            }
        return {
            one: path[len(self.place) + 1 :]
            for one, path in inside.items()
            if path == self.place or path.startswith(f"{self.place}/")
        }
