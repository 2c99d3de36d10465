"""An MCAP file read record by record, for want of a summary; chunks are unpacked only where that is needed."""

from __future__ import annotations

from roslens.live.adapters.bag.chunked import Chunk
from roslens.live.adapters.bag.cursor import Cursor
from roslens.live.adapters.bag.damage import DamageError, FailureLog
from roslens.live.adapters.bag.gather import STOPPED, Gathering
from roslens.live.adapters.bag.mcap_layout import (
    CHANNEL,
    CHUNK,
    DATA_END,
    FOOTER,
    MESSAGE,
    MESSAGE_INDEX,
    PREFIX,
    SCHEMA,
    McapLayout,
)
from roslens.live.adapters.bag.source import Source

_LONGEST_HEAD = 4096


def scan_mcap(source: Source, layout: McapLayout, at: int, failures: FailureLog) -> list[Chunk]:
    """Return the chunks of a file whose data begins at ``at``; learns schemas and channels on the way."""
    gathering = Gathering(source, layout, failures)
    while at < source.size:
        try:
            kind, length = _prefix(source, at)
            if kind in {DATA_END, FOOTER}:
                break
            start = at + PREFIX.size
            whole = gathering.whole(at, start, length)
            end = min(start + length, source.size)
            if kind == CHUNK:
                gathering.begin(_chunk_of(source, start, end, whole))
            elif kind == MESSAGE_INDEX and whole:
                gathering.index(end)
            elif kind == MESSAGE:
                gathering.message(at, end)
            elif kind in {SCHEMA, CHANNEL} and whole:
                gathering.close()
                layout.define(kind, source.read(start, length))
            at = start + length
        except DamageError as damage:
            failures.add(source.path, f"byte {at:,}: {damage}", advice=STOPPED)
            break
    return gathering.finish()


def _prefix(source: Source, at: int) -> tuple[int, int]:
    kind, length = PREFIX.unpack(source.read(at, PREFIX.size))
    if kind == 0:
        raise DamageError("a record of kind 0")
    return kind, length


def _chunk_of(source: Source, at: int, record_end: int, whole: bool) -> Chunk:
    head = Cursor(source.read(at, min(record_end - at, _LONGEST_HEAD)))
    start, end, size, checksum = head.u64(), head.u64(), head.u64(), head.u32()
    compression, packed = head.text(), head.u64()
    content_at = at + head.at
    if packed > record_end - content_at:
        whole, packed = False, record_end - content_at
    return Chunk(start, end, {}, content_at, packed, size, compression, record_end, 0, checksum, not whole)
