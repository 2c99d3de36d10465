"""A cache of which only what is kept under the hash of contents is used."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from roslens.store.cache import Cache, FileStat


class ContentCache(Cache):
    """The cache as seen by files that stand elsewhere than those it knows by path: a revision, written for a look."""

    def stats(self, *, now_s: float) -> dict[str, FileStat]:  # noqa: ARG002 - the shape of every cache
        """Return nothing: what is known of a path is of another file."""
        return {}

    def put_stats(self, stats: Mapping[str, FileStat], *, now_s: float) -> None:
        """Keep nothing by path."""

    def forget(self, paths: Iterable[str]) -> None:
        """Leave alone what is known of paths."""
