"""The configuration of fetching."""

from __future__ import annotations

import msgspec


class FetchSettings(msgspec.Struct, frozen=True, omit_defaults=True):
    """The table ``[fetch]`` of ``roslens.toml``.

    ``rewrite`` maps the beginning of a URL to what takes its place, a mirror say; the longest one that fits is used.
    ``version`` names another branch, tag or commit by the name of a repository, for one whose branch is gone say.
    ``jobs`` is how many repositories are fetched at once.
    """

    rewrite: dict[str, str] = {}
    version: dict[str, str] = {}
    jobs: int = 4
