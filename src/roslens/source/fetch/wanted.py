"""A requested repository, before anything of it is fetched."""

from __future__ import annotations

import msgspec


class Wanted(msgspec.Struct, frozen=True, omit_defaults=True):
    """A repository and what is wanted of it.

    Attributes:
        name: what it is called, and the folder that it comes to, below that of all; may have several parts.
        url: where it is, as its document says it.
        version: a branch, a tag or a commit; empty for the branch that the server shows first.
        kind: ``git``, ``hg``, ``svn`` or ``tar``.
        packages: those that are wanted; none for all.
        commits: how many commits its revision has behind it and with it, where a filter says so; 0 where none does.
        branch: where ``version`` is a commit: the branch that it was found on.
    """

    name: str
    url: str
    version: str = ""
    kind: str = "git"
    packages: tuple[str, ...] = ()
    commits: int = 0
    branch: str = ""
