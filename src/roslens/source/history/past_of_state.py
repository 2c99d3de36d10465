"""What the histories of a workspace's repositories said when they stood together at some time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.failure import Failure
from roslens.model.process import RepositoryProcess
from roslens.model.source import SourceFile
from roslens.source.history.past_of_commit import PastOfCommit
from roslens.source.keys import key_of


class PastOfState(msgspec.Struct, frozen=True):
    """The past of each repository that had a commit by then.

    Attributes:
        parts: of the repositories.
        failures: of the state.
    """

    parts: tuple[PastOfCommit, ...]
    failures: tuple[Failure, ...] = ()

    @property
    def key(self) -> str:
        """A key of all that shapes what is reported."""
        return key_of([one.key for one in self.parts], self.failures)

    def tell(
        self,
        packages: Mapping[str, str],
        files: Mapping[str, Sequence[SourceFile]],
        complexity: Mapping[str, float],
    ) -> tuple[tuple[RepositoryProcess, ...], tuple[Failure, ...]]:
        """Return what the histories say, and what they cannot say."""
        reported = [one.tell(packages, files, complexity) for one in self.parts]
        return tuple(one for found, _ in reported for one in found), tuple(
            one for _, found in reported for one in found
        )
