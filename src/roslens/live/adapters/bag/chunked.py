"""A file made of chunks that are followed by an index of their messages: MCAP and ROS 1 bags."""

from __future__ import annotations

import zlib
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from roslens.live.adapters.bag.block import FOREVER, Block, Bytes, Ints, Load, Message, Portion
from roslens.live.adapters.bag.channel import Channel
from roslens.live.adapters.bag.damage import DamageError, FailureLog
from roslens.live.adapters.bag.decompress import LARGEST, decompress, unpack_start
from roslens.live.adapters.bag.layout import Entries, Layout, Walk
from roslens.live.adapters.bag.source import Source
from roslens.live.adapters.bag.stamp import stamps_of

LOST = "Its messages are left out. The other parts of the recording are read."


_INDEX_USED = "Its index is used, its messages are not."


class Chunk(NamedTuple):
    """Where a chunk lies and what is in it; times are nanoseconds.

    ``counts`` are messages by channel where the index tells. Without an index (``index_length`` 0) the chunk is read
    record by record. ``cut`` says that the file ends inside of it.
    """

    start: int
    end: int
    counts: dict[int, int]
    at: int
    packed: int
    size: int
    compression: str
    index_at: int = 0
    index_length: int = 0
    checksum: int = 0
    cut: bool = False


class ChunkedPart:
    """One file of chunks, of which only what is asked for is unpacked."""

    def __init__(
        self,
        source: Source,
        generation: str,
        layout: Layout,
        chunks: Sequence[Chunk],
        failures: FailureLog,
        counts: dict[int, int] | None = None,
    ) -> None:
        self.path = source.path
        self.exact_sizes = False
        self.generation = generation
        self.channels: Mapping[int, Channel] = layout.channels
        self.failures = failures
        filled = [chunk for chunk in chunks if chunk.start <= chunk.end and (chunk.end or chunk.counts)]
        self.start = min((chunk.start for chunk in filled), default=FOREVER)
        self.end = max((chunk.end for chunk in filled), default=0)
        self.counts: Mapping[int, int] = counts if counts is not None else _sums(chunks)
        self._source = source
        self._layout = layout
        self._chunks = sorted(chunks, key=lambda chunk: (chunk.start, chunk.at))
        self._defining = _defining(chunks)

    def portions(self, stamped: Collection[int]) -> Iterator[Portion]:
        """Yield the chunks by the time of their first message."""
        for chunk in self._chunks:
            yield Portion(chunk.start, partial(self._read, chunk, stamped))

    def loads(self, wanted: Collection[int]) -> Iterator[Load]:
        """Yield the messages of the chunks by the time of their first message."""
        for chunk in self._chunks:
            yield Load(chunk.start, partial(self._load, chunk, wanted))

    def _read(self, chunk: Chunk, stamped: Collection[int]) -> list[Block]:
        entries = self._entries(chunk)
        if entries is None:
            return self._read_records(chunk, stamped)
        wanted = chunk.at in self._defining or any(entry.channel in stamped for entry in entries)
        content = self._content(chunk) if wanted else None
        if content is not None and (found := self._located(content, entries)) is not None:
            return [
                Block(
                    entry.channel,
                    entry.times,
                    sizes,
                    self._stamps(content, starts, sizes, entry.channel) if entry.channel in stamped else None,
                )
                for entry, (starts, sizes) in zip(entries, found, strict=True)
            ]
        if content is not None and (blocks := self._instead_of_index(chunk, entries, stamped)) is not None:
            return blocks
        sizes = _gaps_between(entries, chunk.size, self._layout.overhead)
        return [Block(entry.channel, entry.times, size) for entry, size in zip(entries, sizes, strict=True)]

    def _instead_of_index(self, chunk: Chunk, entries: list[Entries], stamped: Collection[int]) -> list[Block] | None:
        """Read the records of a chunk whose index points at no messages; None if the index is the better witness."""
        blocks = self._read_records(chunk, stamped)
        found, promised = (sum(len(each.times) for each in them) for them in (blocks, entries))
        better = found >= promised
        advice = "The chunk is read record by record." if better else _INDEX_USED
        self._tell(chunk, f"{promised:,} index entries and {found:,} messages, and some entries point at none", advice)
        return blocks if better else None

    def _read_records(self, chunk: Chunk, stamped: Collection[int]) -> list[Block]:
        content, walk = self._walk(chunk)
        blocks = []
        for channel in self._known(np.unique(walk.channels).tolist()):
            mine = walk.channels == channel
            starts, sizes = walk.starts[mine], walk.sizes[mine]
            stamps = self._stamps(content, starts, sizes, channel) if channel in stamped else None
            blocks.append(Block(channel, walk.times[mine], sizes, stamps))
        return blocks

    def _load(self, chunk: Chunk, wanted: Collection[int]) -> list[Message]:
        entries = self._entries(chunk)
        if entries is not None:
            entries = [entry for entry in entries if entry.channel in wanted]
            if not entries:
                return []
            content = self._content(chunk)
            if content is None:
                return []
            found = self._located(content, entries)
            if found is not None:
                return [
                    Message(time, entry.channel, content[start : start + size].tobytes())
                    for entry, (starts, sizes) in zip(entries, found, strict=True)
                    for time, start, size in zip(entry.times.tolist(), starts.tolist(), sizes.tolist(), strict=True)
                ]
        content, walk = self._walk(chunk)
        rows = zip(*(column.tolist() for column in walk[:4]), strict=True)
        return [
            Message(time, channel, content[start : start + size].tobytes())
            for channel, time, start, size in rows
            if channel in wanted and channel in self.channels
        ]

    def _entries(self, chunk: Chunk) -> list[Entries] | None:
        """Return the index of a chunk; None where there is none to be trusted."""
        if not chunk.index_length:
            return None
        try:
            entries = self._layout.entries(self._source.read(chunk.index_at, chunk.index_length))
        except DamageError as damage:
            self._tell(chunk, f"an index that cannot be read: {damage}", "The chunk is read record by record.")
            return None
        known = set(self._known([entry.channel for entry in entries]))
        return [entry for entry in entries if entry.channel in known]

    def _known(self, channels: list[int]) -> list[int]:
        for channel in channels:
            if channel not in self.channels:
                self.failures.add(self.path, f"messages of channel {channel}, which is defined nowhere", advice=LOST)
        return [channel for channel in channels if channel in self.channels]

    def _located(self, content: Bytes, entries: list[Entries]) -> list[tuple[Ints, Ints]] | None:
        if not entries:
            return []
        found = self._layout.locate(content, np.concatenate([entry.offsets for entry in entries]))
        if found is None:
            return None
        return list(zip(_parted(found[0], entries), _parted(found[1], entries), strict=True))

    def _stamps(self, content: Bytes, starts: Ints, sizes: Ints, channel: int) -> Ints:
        return stamps_of(content, starts, sizes, self.channels[channel])

    def _content(self, chunk: Chunk) -> Bytes | None:
        """Return what a chunk holds, None where it is damaged."""
        try:
            content = decompress(self._source.read(chunk.at, chunk.packed), chunk.compression, chunk.size)
        except DamageError as damage:
            self._tell(chunk, str(damage), _INDEX_USED)
            return None
        if chunk.checksum and zlib.crc32(content) != chunk.checksum:
            self._tell(chunk, "a checksum that is wrong", _INDEX_USED)
            return None
        return np.frombuffer(content, np.uint8)

    def _walk(self, chunk: Chunk) -> tuple[Bytes, Walk]:
        """Read a chunk without an index as far as that goes."""
        content, walk, reason = walk_chunk(self._source, self._layout, chunk)
        if reason and not chunk.cut:
            self._tell(chunk, reason, "Everything before it is read.")
        return np.frombuffer(content, np.uint8), walk

    def _tell(self, chunk: Chunk, what: str, advice: str) -> None:
        self.failures.add(self.path, f"the chunk at byte {chunk.at:,} has {what}", advice=advice)


def walk_chunk(source: Source, layout: Layout, chunk: Chunk) -> tuple[bytes, Walk, str]:
    """Read a chunk record by record; return its content, the messages and why it ends early, if it does."""
    try:
        content, reason = unpack_start(source.read(chunk.at, chunk.packed), chunk.compression, chunk.size)
    except DamageError as damage:
        content, reason = b"", str(damage)
    if chunk.checksum and not reason and zlib.crc32(content) != chunk.checksum:
        reason = "a checksum that is wrong"
    walk = layout.walk(content)
    return content, walk, reason or walk.stopped


def _gaps_between(entries: list[Entries], size: int, overhead: int) -> list[Ints]:
    """Return sizes as the distances from one record to the next, whatever its channel.

    Where a chunk claims a size that none has, its last message counts as empty.
    """
    if not entries:
        return []
    offsets = np.concatenate([entry.offsets for entry in entries])
    # Those of each channel mostly rise already, and a stable sort merges what is sorted.
    order = np.argsort(offsets, kind="stable")
    ordered = offsets[order]
    gaps = np.empty_like(offsets)
    np.subtract(ordered[1:], ordered[:-1], out=gaps[:-1])
    gaps[-1] = max(size - int(ordered[-1]), 0) if size <= LARGEST else 0
    gaps -= overhead
    np.maximum(gaps, 0, out=gaps)
    sizes = np.empty_like(offsets)
    sizes[order] = gaps
    return _parted(sizes, entries)


def _parted(numbers: Ints, entries: list[Entries]) -> list[Ints]:
    """Cut numbers of all entries into those of each."""
    parts = []
    begin = 0
    for entry in entries:
        end = begin + len(entry.times)
        parts.append(numbers[begin:end])
        begin = end
    return parts


def _defining(chunks: Sequence[Chunk]) -> set[int]:
    """Return the places of the chunks in which a channel comes first: definitions lie between messages there.

    Distances between the messages of these chunks would count definitions, which are often larger, as messages.
    """
    seen: set[int] = set()
    found = set()
    for chunk in sorted(chunks, key=lambda chunk: chunk.at):
        if not seen.issuperset(chunk.counts):
            seen.update(chunk.counts)
            found.add(chunk.at)
    return found


def _sums(chunks: Sequence[Chunk]) -> dict[int, int]:
    total: dict[int, int] = {}
    for chunk in chunks:
        for channel, count in chunk.counts.items():
            total[channel] = total.get(channel, 0) + count
    return total
