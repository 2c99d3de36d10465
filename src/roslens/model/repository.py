"""A repository of a workspace, as a run saw it."""

from __future__ import annotations

import msgspec


class FoundRepository(msgspec.Struct, frozen=True, omit_defaults=True):
    """A repository that packages of a run are in.

    Attributes:
        name: of its folder, or what a fetched set calls it.
        path: of its folder below the root of the workspace; ``.`` where the workspace lies in it.
        packages: ids of its packages, in their order.
        commit: that its files are of, with ``+`` where they differ from it; empty where git does not tell.
        url: where it came from; empty where that is not known.
        version: branch, tag or commit that was asked for, where it was fetched.
    """

    name: str
    path: str
    packages: tuple[str, ...] = ()
    commit: str = ""
    url: str = ""
    version: str = ""
