"""What history has about one entity: a repository, a package or a file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import cached_property

from roslens.model.entity import EntityKind
from roslens.source.history.commit_log import Change, Commit

DAY_S = 86_400.0


class Touched:
    """The commits that count for an entity, with what they changed of it.

    Of a repository every commit counts; of a package or file those that are no merge and change something of it.
    """

    def __init__(
        self, kind: EntityKind, commits: Sequence[tuple[Commit, Sequence[Change]]], *, as_of_s: float, head_s: float
    ) -> None:
        """Bring together what metrics are computed of.

        Args:
            kind: of the entity.
            commits: newest first, each with the changes of files of the entity.
            as_of_s: the time at which ages are taken, in seconds since 1970.
            head_s: when the head was committed.
        """
        self.kind = kind
        self.commits = commits
        self.as_of_s = as_of_s
        self.head_s = head_s

    @cached_property
    def times(self) -> list[int]:
        """When the commits were made, in seconds since 1970, in no order."""
        return [commit.time_s for commit, _ in self.commits]

    @cached_property
    def shares(self) -> list[int]:
        """How many of the commits each person made or helped to make, the most first."""
        return sorted(Counter(one for commit, _ in self.commits for one in commit.people).values(), reverse=True)
