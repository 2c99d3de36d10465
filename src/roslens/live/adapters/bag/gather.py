"""Chunks gathered while the records of a file go by, for want of an index of the whole file."""

from __future__ import annotations

import numpy as np

from roslens.live.adapters.bag.block import Ints
from roslens.live.adapters.bag.chunked import Chunk, walk_chunk
from roslens.live.adapters.bag.damage import DamageError, FailureLog
from roslens.live.adapters.bag.layout import Layout
from roslens.live.adapters.bag.source import Source

_RUN_BYTES = 1 << 23
STOPPED = "Everything before it is read."


class Gathering:
    """What is known while going from record to record: a chunk whose index may follow, or a run of bare messages.

    A run of messages outside of chunks becomes a chunk that is neither packed nor indexed.
    """

    def __init__(self, source: Source, layout: Layout, failures: FailureLog) -> None:
        self._source = source
        self._layout = layout
        self._failures = failures
        self._chunks: list[Chunk] = []
        self._open: Chunk | None = None
        self._run: tuple[int, int] | None = None

    def finish(self) -> list[Chunk]:
        """Return all chunks."""
        self.close()
        return self._chunks

    def whole(self, at: int, start: int, length: int) -> bool:
        """Return whether a record at ``at`` fits into the file; note where not."""
        left = self._source.size - start
        if length <= left:
            return True
        what = f"byte {at:,}: a record of {length:,} bytes in a file that ends after {left:,}"
        self._failures.add(self._source.path, what, advice=STOPPED)
        return False

    def begin(self, chunk: Chunk) -> None:
        """A chunk begins; its index may follow."""
        self.close()
        self._open = chunk

    def index(self, end: int) -> None:
        """An index record goes by that ends at ``end``."""
        self._end_run()
        if self._open is not None:
            self._open = self._open._replace(index_length=end - self._open.index_at)

    def message(self, start: int, end: int) -> None:
        """A message outside of chunks goes by."""
        if self._open is not None:
            self.close()
        self._run = (self._run[0] if self._run else start, end)
        if end - self._run[0] > _RUN_BYTES:
            self._end_run()

    def close(self) -> None:
        """Another record goes by."""
        self._end_run()
        if self._open is not None:
            chunk, self._open = self._open, None
            self._chunks.append(_surveyed(self._source, self._layout, chunk))

    def _end_run(self) -> None:
        if self._run is not None:
            (start, end), self._run = self._run, None
            end = min(end, self._source.size)
            run = Chunk(0, 0, {}, start, end - start, end - start, "", cut=True)
            self._chunks.append(_surveyed(self._source, self._layout, run))


def _surveyed(source: Source, layout: Layout, chunk: Chunk) -> Chunk:
    """Return the chunk with its counts and times; learns the channels that are defined in it.

    A chunk whose index names a channel that is not known yet is unpacked once, because it defines it.
    """
    if chunk.index_length:
        try:
            entries = layout.entries(source.read(chunk.index_at, chunk.index_length))
        except DamageError:
            entries = []
        if entries:
            counts = {entry.channel: len(entry.times) for entry in entries}
            if not layout.channels.keys() >= counts.keys():
                walk_chunk(source, layout, chunk)
            return _spanning(chunk, counts, np.concatenate([entry.times for entry in entries]))
    walk = walk_chunk(source, layout, chunk)[1]
    channels, counted = np.unique(walk.channels, return_counts=True)
    counts = dict(zip(channels.tolist(), counted.tolist(), strict=True))
    return _spanning(chunk._replace(index_length=0), counts, walk.times)


def _spanning(chunk: Chunk, counts: dict[int, int], times: Ints) -> Chunk:
    if not len(times):
        return chunk._replace(start=0, end=0, counts={})
    return chunk._replace(start=int(times.min()), end=int(times.max()), counts=counts)
