"""Records of MCAP: https://mcap.dev/spec."""

from __future__ import annotations

import struct
from typing import NamedTuple

import numpy as np

from roslens.live.adapters.bag.block import FOREVER, Bytes, Ints
from roslens.live.adapters.bag.channel import Channel, resolved
from roslens.live.adapters.bag.cursor import Cursor
from roslens.live.adapters.bag.damage import DamageError
from roslens.live.adapters.bag.layout import Entries, Walk, cut, numbers_at, walked

MAGIC = b"\x89MCAP0\r\n"

HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(1, 9)
STATISTICS, DATA_END = 0x0B, 0x0F

PREFIX = struct.Struct("<BQ")
_INDEX = struct.Struct("<HI")
_MESSAGE = struct.Struct("<HIQQ")
_LANGUAGES = {"ros1msg": "msg", "ros2msg": "msg", "ros2idl": "idl", "omgidl": "idl"}


class Schema(NamedTuple):
    """The type of channels."""

    name: str
    language: str
    definition: str


class McapLayout:
    """What is known of a file's schemas and channels, and how its chunks are read."""

    overhead = PREFIX.size + _MESSAGE.size

    def __init__(self) -> None:
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[int, Channel] = {}

    def define(self, kind: int, content: bytes) -> None:
        """Learn a schema or a channel.

        Raises:
            DamageError: the record is cut.
        """
        cursor = Cursor(content)
        number = cursor.u16()
        if kind == SCHEMA:
            name, encoding = cursor.text(), cursor.text()
            self.schemas[number] = Schema(name, _LANGUAGES.get(encoding, ""), cursor.text())
            return
        schema = self.schemas.get(cursor.u16(), Schema("", "", ""))
        topic, encoding = cursor.text(), cursor.text()
        extra = cursor.table()
        self.channels[number] = Channel(
            resolved(topic),
            schema.name,
            extra.get("topic_type_hash", "") or extra.get("md5sum", ""),
            resolved(extra.get("callerid", "")),
            extra.get("offered_qos_profiles", ""),
            schema.definition,
            schema.language,
            encoding,
        )

    def entries(self, region: bytes) -> list[Entries]:
        """Read message index records."""
        pieces = []
        at, end = 0, len(region)
        while at + PREFIX.size <= end:
            kind, length = PREFIX.unpack_from(region, at)
            at += PREFIX.size
            if length > end - at:
                raise DamageError(f"an index record of {length:,} bytes where {end - at:,} are left")
            if kind == MESSAGE_INDEX:
                if length < 6:
                    raise DamageError(f"an index record of {length} bytes")
                channel, size = _INDEX.unpack_from(region, at)
                if size > length - 6 or size % 16:
                    raise DamageError(f"an index of {size:,} bytes in a record of {length:,}")
                if size:
                    pieces.append((channel, region[at + 6 : at + 6 + size]))
            at += length
        # Joined first: two columns are taken apart faster than two of each channel.
        table = np.frombuffer(b"".join([piece for _, piece in pieces]), "<i8").reshape(-1, 2)
        times, offsets = table[:, 0].copy(), table[:, 1].copy()
        return cut([(channel, len(piece) // 16) for channel, piece in pieces], times, offsets)

    def locate(self, content: Bytes, offsets: Ints) -> tuple[Ints, Ints] | None:
        """Find messages by where their records begin."""
        if not len(offsets):
            return offsets, offsets
        starts = offsets + self.overhead
        if int(offsets.min()) < 0 or int(offsets.max()) > len(content) - self.overhead:
            return None
        sizes = numbers_at(content, offsets + 1, np.int64) - _MESSAGE.size
        right = (content[offsets] == MESSAGE) & (sizes >= 0) & (sizes <= len(content) - starts)
        return (starts, sizes) if bool(right.all()) else None

    def walk(self, content: bytes) -> Walk:
        """Read the records of a chunk, or of a file without chunks."""
        rows = []
        at, end = 0, len(content)
        stopped = ""
        while at < end:
            if at + PREFIX.size > end:
                stopped = f"{end - at} bytes at its end that are not a record"
                break
            kind, length = PREFIX.unpack_from(content, at)
            start = at + PREFIX.size
            if length > end - start:
                stopped = f"a record of {length:,} bytes where {end - start:,} are left"
                break
            at = start + length
            if kind == MESSAGE and length >= _MESSAGE.size:
                channel, _, time, _ = _MESSAGE.unpack_from(content, start)
                rows.append((channel, min(time, FOREVER), start + _MESSAGE.size, length - _MESSAGE.size))
            elif kind in {SCHEMA, CHANNEL}:
                try:
                    self.define(kind, content[start:at])
                except DamageError as damage:
                    stopped = f"a definition with {damage}"
        return walked(rows, stopped)
