"""The cache of a workspace, asked about a folder that holds its past revisions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from roslens.store.cache import Cache, FileStat


class PastCache(Cache):
    """What files are is shared with the workspace, by content; where they stand in the folder is known here only.

    A file that is written anew has to be forgotten: it may have the size, time stamp and inode of what was there.
    """

    _stats: dict[str, FileStat]

    def stats(self, *, now_s: float) -> dict[str, FileStat]:  # noqa: ARG002 - nobody else changes these files
        """Return what is known of the files of the folder, by path."""
        return dict(self._known_stats())

    def put_stats(self, stats: Mapping[str, FileStat], *, now_s: float) -> None:  # noqa: ARG002 - as above
        """Remember what a look at files reported."""
        self._known_stats().update(stats)

    def forget(self, paths: Iterable[str]) -> None:
        """Remove what is known of files."""
        for path in paths:
            self._known_stats().pop(path, None)

    def _known_stats(self) -> dict[str, FileStat]:
        if not hasattr(self, "_stats"):
            self._stats = {}
        return self._stats
