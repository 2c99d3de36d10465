"""One MCAP file: its summary where it has one, its records where the recorder never got to write that."""

from __future__ import annotations

import struct
import zlib
from typing import NamedTuple

from roslens.live.adapters.bag.chunked import Chunk, ChunkedPart
from roslens.live.adapters.bag.cursor import Cursor
from roslens.live.adapters.bag.damage import DamageError, FailureLog
from roslens.live.adapters.bag.mcap_layout import (
    CHANNEL,
    CHUNK_INDEX,
    DATA_END,
    FOOTER,
    HEADER,
    MAGIC,
    PREFIX,
    SCHEMA,
    STATISTICS,
    McapLayout,
)
from roslens.live.adapters.bag.mcap_scan import scan_mcap
from roslens.live.adapters.bag.source import Source

_FOOTER_BYTES = PREFIX.size + 20
_INDEX_HEAD = PREFIX.size + 6
_PLACE = struct.Struct("<HQ")
_REINDEX = "The readable part is used. `mcap recover` writes a whole file."


class _Summary(NamedTuple):
    """The summary after the data of a file: chunks, messages by channel, and the declared number of chunks."""

    chunks: list[Chunk]
    counts: dict[int, int]
    total: int


def open_mcap(source: Source) -> ChunkedPart:
    """Read the metadata of a file.

    Raises:
        DamageError: nothing of it can be used.
    """
    failures = FailureLog()
    layout = McapLayout()
    profile, data_at = _profile(source)
    summary = None
    try:
        summary = _summary(source, layout)
    except DamageError as damage:
        failures.add(source.path, f"no summary that can be read: {damage}", advice=_REINDEX)
        layout = McapLayout()
    if summary is None or (not summary.chunks and summary.total) or _lacks_channels(summary, layout):
        scanned = scan_mcap(source, layout, data_at, failures)
        part = ChunkedPart(source, "ros2", layout, scanned, failures)
    else:
        known = summary.counts if sum(summary.counts.values()) == summary.total else None
        part = ChunkedPart(source, "ros2", layout, summary.chunks, failures, known or None)
    encodings = {channel.encoding for channel in layout.channels.values()}
    if profile == "ros1" or encodings == {"ros1"}:
        part.generation = "ros1"
    return part


def _profile(source: Source) -> tuple[str, int]:
    """Return the profile a file names, and where its data begins."""
    start = len(MAGIC)
    kind, length = PREFIX.unpack(source.read(start, PREFIX.size))
    start += PREFIX.size
    if kind != HEADER:
        raise DamageError(f"a first record of kind {kind}")
    return Cursor(source.read(start, length)).text(), start + length


def _summary(source: Source, layout: McapLayout) -> _Summary | None:
    """Read the summary; None in a file that has none on purpose."""
    end = source.size - len(MAGIC)
    foot_at = end - _FOOTER_BYTES
    if foot_at < len(MAGIC) or source.read(end, len(MAGIC)) != MAGIC:
        raise DamageError("the file does not end as it should, its recorder was probably killed")
    kind, length = PREFIX.unpack(source.read(foot_at, PREFIX.size))
    if kind != FOOTER or length != _FOOTER_BYTES - PREFIX.size:
        raise DamageError(f"a last record of kind {kind} with {length:,} bytes")
    footer = Cursor(source.read(foot_at + PREFIX.size, length))
    start, _, checksum = footer.u64(), footer.u64(), footer.u32()
    if not start:
        return None
    content = source.read(start, foot_at - start)
    covered = content + source.read(foot_at, _FOOTER_BYTES - 4)
    if checksum and zlib.crc32(covered) != checksum:
        raise DamageError("its checksum is wrong")
    return _summary_of(content, layout)


def _summary_of(content: bytes, layout: McapLayout) -> _Summary:
    cursor = Cursor(content)
    chunks = []
    counts: dict[int, int] = {}
    total = 0
    while cursor.left:
        kind = cursor.take(1)[0]
        body = cursor.take(cursor.u64())
        if kind in {SCHEMA, CHANNEL}:
            layout.define(kind, body)
        elif kind == CHUNK_INDEX:
            chunks.append(_chunk_of(Cursor(body)))
        elif kind == STATISTICS:
            total, counts = _statistics(Cursor(body))
        elif kind in {FOOTER, DATA_END}:
            break
    return _Summary(chunks, counts, total)


def _statistics(cursor: Cursor) -> tuple[int, dict[int, int]]:
    total = cursor.u64()
    cursor.take(2 + 4 * 4 + 2 * 8)
    pairs = Cursor(cursor.take(cursor.u32()))
    counts = {}
    while pairs.left:
        channel = pairs.u16()
        counts[channel] = pairs.u64()
    return total, counts


def _chunk_of(cursor: Cursor) -> Chunk:
    """Read a chunk index record."""
    start, end, at, length = cursor.u64(), cursor.u64(), cursor.u64(), cursor.u64()
    pairs = cursor.take(cursor.u32())
    index_length = cursor.u64()
    compression, packed, size = cursor.text(), cursor.u64(), cursor.u64()
    index_at = at + length
    if len(pairs) % _PLACE.size:
        raise DamageError(f"places of an index in {len(pairs):,} bytes")
    places = sorted((place, channel) for channel, place in _PLACE.iter_unpack(pairs))
    ends = [place for place, _ in places] + [index_at + index_length]
    counts = {
        channel: max(following - place - _INDEX_HEAD, 0) // 16
        for (place, channel), following in zip(places, ends[1:], strict=True)
    }
    # Of the record before its content: two times, size, checksum, the text of the compression and two lengths.
    content_at = at + PREFIX.size + 40 + len(compression.encode())
    if not places:
        index_length = 0
    return Chunk(start, end, counts, content_at, packed, size, compression, index_at, index_length)


def _lacks_channels(summary: _Summary, layout: McapLayout) -> bool:
    """Return whether messages are of channels that the summary, as it may, does not repeat."""
    used = {channel for chunk in summary.chunks for channel in chunk.counts} | summary.counts.keys()
    return not used <= layout.channels.keys()
