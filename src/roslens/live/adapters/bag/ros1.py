"""One ROS 1 bag: its index section where it has one, its records where the recorder was killed before."""

from __future__ import annotations

import struct
from typing import NamedTuple

from roslens.live.adapters.bag.chunked import Chunk, ChunkedPart
from roslens.live.adapters.bag.damage import DamageError, FailureLog
from roslens.live.adapters.bag.gather import STOPPED, Gathering
from roslens.live.adapters.bag.ros1_layout import (
    BAG_HEADER,
    CHUNK,
    CHUNK_INFO,
    CONNECTION,
    INDEX,
    MAGIC,
    MESSAGE,
    Ros1Layout,
    fields_of,
    number,
    operation,
    split,
    time_of,
)
from roslens.live.adapters.bag.source import Source

_LONGEST_HEADER = 1 << 20
_REINDEX = "The readable part is used. `rosbag reindex` writes a whole file."


class _Record(NamedTuple):
    """A record in the file; its content may reach beyond the end."""

    fields: dict[str, bytes]
    start: int
    length: int

    @property
    def end(self) -> int:
        return self.start + self.length


def open_ros1(source: Source) -> ChunkedPart:
    """Read the metadata of a bag.

    Raises:
        DamageError: nothing of it can be used.
    """
    failures = FailureLog()
    head = _record_at(source, len(MAGIC))
    if operation(head.fields) != BAG_HEADER:
        raise DamageError(f"a first record of kind {operation(head.fields)}")
    if encryptor := head.fields.get("encryptor", b""):
        raise DamageError(f'content encrypted with "{encryptor.decode(errors="replace")}"')
    layout = Ros1Layout()
    try:
        chunks = _indexed(source, layout, head.fields)
    except DamageError as damage:
        failures.add(source.path, f"no index: {damage}", advice=_REINDEX)
        layout = Ros1Layout()
        chunks = _scanned(source, layout, head.end, failures)
    return ChunkedPart(source, "ros1", layout, chunks, failures)


def _indexed(source: Source, layout: Ros1Layout, head: dict[str, bytes]) -> list[Chunk]:
    """Read connections and chunks from the section that the header points to."""
    index_at = number(head, "index_pos", 8)
    if not index_at:
        raise DamageError("the bag was never closed, its recorder was probably killed")
    content = source.read(index_at, source.size - index_at)
    infos = []
    at = 0
    while at < len(content):
        fields, start, length = split(content, at)
        at = start + length
        kind = operation(fields)
        if kind == CONNECTION:
            layout.define(fields, content[start:at])
        elif kind == CHUNK_INFO:
            infos.append((number(fields, "chunk_pos", 8), fields, _counts(content[start:at])))
    if len(infos) != number(head, "chunk_count", 4) or len(layout.channels) != number(head, "conn_count", 4):
        raise DamageError(
            f"{len(infos):,} chunks and {len(layout.channels):,} connections, not as many as in the header"
        )
    infos.sort(key=lambda info: info[0])
    ends = [*(place for place, _, _ in infos[1:]), index_at] if infos else []
    return [
        _chunk_at(source, place, end)._replace(
            start=time_of(fields, "start_time"), end=time_of(fields, "end_time"), counts=counts
        )
        for (place, fields, counts), end in zip(infos, ends, strict=True)
    ]


def _counts(content: bytes) -> dict[int, int]:
    return {channel: count for channel, count in struct.iter_unpack("<II", content[: len(content) // 8 * 8]) if count}


def _chunk_at(source: Source, place: int, end: int) -> Chunk:
    """Return the chunk that begins at a place; its index reaches to ``end``."""
    record = _record_at(source, place)
    if operation(record.fields) != CHUNK or record.end > end:
        raise DamageError(f"no chunk at byte {place:,}")
    return _chunk_of(record, end - record.end)


def _chunk_of(record: _Record, index_length: int, cut: bool = False) -> Chunk:
    compression = record.fields.get("compression", b"").decode(errors="replace")
    size = number(record.fields, "size", 4)
    return Chunk(0, 0, {}, record.start, record.length, size, compression, record.end, index_length, cut=cut)


def _scanned(source: Source, layout: Ros1Layout, at: int, failures: FailureLog) -> list[Chunk]:
    """Find chunks and what follows them by going from record to record.

    A killed recorder leaves its last chunk with a size of 0, and the messages that belong to it bare behind it.
    """
    gathering = Gathering(source, layout, failures)
    while at < source.size:
        try:
            record = _record_at(source, at)
            kind = operation(record.fields)
            whole = gathering.whole(at, record.start, record.length)
            end = min(record.end, source.size)
            if kind == CHUNK:
                record = record._replace(length=end - record.start)
                gathering.begin(_chunk_of(record, 0, not whole))
            elif kind == INDEX and whole:
                gathering.index(end)
            elif kind == MESSAGE:
                gathering.message(at, end)
            elif kind == CONNECTION and whole:
                gathering.close()
                layout.define(record.fields, source.read(record.start, record.length))
            at = end
        except DamageError as damage:
            failures.add(source.path, f"byte {at:,}: {damage}", advice=STOPPED)
            break
    return gathering.finish()


def _record_at(source: Source, at: int) -> _Record:
    """Read the header of a record."""
    length = int.from_bytes(source.read(at, 4), "little")
    if length > _LONGEST_HEADER:
        raise DamageError(f"a header of {length:,} bytes")
    fields = fields_of(source.read(at + 4, length))
    start = at + 8 + length
    return _Record(fields, start, int.from_bytes(source.read(start - 4, 4), "little"))
