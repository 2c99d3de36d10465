"""What became of a repository that was wanted: its commit, or why there is none."""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.source.fetch.wanted import Wanted

LOCK = "fetched.repos"
"""Name of the lock in the folder that repositories are fetched into."""


class How(str, Enum):
    """How a repository came to be there."""

    FETCHED = "fetched"
    KEPT = "kept"
    UPDATED = "updated"
    FAILED = "failed"


class Taken(msgspec.Struct, frozen=True, omit_defaults=True):
    """A repository after the attempt to have it here.

    Attributes:
        wanted: what was asked for.
        how: what was done.
        at: which revision was asked for, as ``--at`` had it.
        commit: that is in the folder; empty where it failed.
        commits: commits behind it and with it; 0 where the clone is shallow.
        day: on which it was committed, in ISO 8601.
        depth: how many commits of history were asked for; 0 for all.
        whole: whether the content of past revisions is there too.
        notes: what else a reader should know.
        failure: why there is no commit.
        submodules: whether submodules are there too.
    """

    wanted: Wanted
    how: How
    at: str = ""
    commit: str = ""
    commits: int = 0
    day: str = ""
    depth: int = 0
    whole: bool = False
    notes: tuple[str, ...] = ()
    failure: str = ""
    submodules: bool = False

    def answers(self, wanted: Wanted, at: str, depth: int, *, whole: bool, submodules: bool = False) -> bool:
        """Return whether it is what is wanted now, so that nothing has to be asked of a server."""
        asked = (wanted.url, wanted.version, wanted.commits if at == "count" else 0, at, depth)
        mine = (self.wanted.url, self.wanted.version, self.wanted.commits if at == "count" else 0, self.at, self.depth)
        return bool(self.commit) and asked == mine and self.whole >= whole and self.submodules >= submodules
