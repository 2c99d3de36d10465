"""Records of ROS 1 bags: http://wiki.ros.org/Bags/Format/2.0."""

from __future__ import annotations

import struct
from typing import NamedTuple

import numpy as np

from roslens.live.adapters.bag.block import Bytes, Ints
from roslens.live.adapters.bag.channel import Channel, resolved
from roslens.live.adapters.bag.damage import DamageError
from roslens.live.adapters.bag.layout import Entries, Walk, cut, numbers_at, walked

MAGIC = b"#ROSBAG V2.0\n"

MESSAGE, BAG_HEADER, INDEX, CHUNK, CHUNK_INFO, CONNECTION = range(2, 8)

_U32 = struct.Struct("<I")
_SECOND = 1_000_000_000
_MESSAGE_HEADER = 38
_OP = int.from_bytes(b"\x04\x00\x00\x00op=\x02", "little")


def fields_of(header: bytes) -> dict[str, bytes]:
    """Return the fields of a record's header, or of a connection's content.

    Raises:
        DamageError: a field is cut or has no name.
    """
    found = {}
    at = 0
    while at < len(header):
        if at + 4 > len(header):
            raise DamageError(f"{len(header) - at} bytes at the end of a header that are not a field")
        length = _U32.unpack_from(header, at)[0]
        at += 4
        name, equals, value = header[at : at + length].partition(b"=")
        if length > len(header) - at or not equals:
            raise DamageError(f"a field of a header of {length:,} bytes where {len(header) - at:,} are left")
        found[name.decode(errors="replace")] = value
        at += length
    return found


def number(fields: dict[str, bytes], name: str, width: int) -> int:
    """Return a field that holds a number.

    Raises:
        DamageError: the field is missing or has another width.
    """
    value = fields.get(name, b"")
    if len(value) != width:
        raise DamageError(f'a record whose field "{name}" has {len(value)} bytes where {width} are expected')
    return int.from_bytes(value, "little")


def time_of(fields: dict[str, bytes], name: str) -> int:
    """Return a field that holds a time, in nanoseconds.

    Raises:
        DamageError: the field is missing or has another width.
    """
    both = number(fields, name, 8)
    return (both & 0xFFFFFFFF) * _SECOND + (both >> 32)


def operation(fields: dict[str, bytes]) -> int:
    """Return what kind of record a header belongs to.

    Raises:
        DamageError: it does not say.
    """
    return number(fields, "op", 1)


class _Form(NamedTuple):
    """How the header of an index record is written: those of a bag differ in two numbers alone.

    ``around`` is what stands before, between and behind the numbers; ``parts`` reads these, the numbers between them,
    and the length of the content; ``turned`` says that the count comes first.
    """

    around: tuple[bytes, bytes, bytes]
    parts: struct.Struct
    turned: bool

    @classmethod
    def of(cls, head: bytes) -> _Form | None:
        """Return the form of a record's beginning up to its content; None where the numbers cannot be determined."""
        head = head[:-4]
        if head.count(b"conn=") != 1 or head.count(b"count=") != 1:
            return None
        channel, count = head.index(b"conn=") + 5, head.index(b"count=") + 6
        first, second = min(channel, count), max(channel, count)
        around = head[:first], head[first + 4 : second], head[second + 4 :]
        parts = struct.Struct("<{}sI{}sI{}sI".format(*map(len, around)))
        return cls(around, parts, first == count)

    def read(self, region: bytes, at: int) -> tuple[int, int, int, int] | None:
        """Return channel, count, and start and length of the content, of a record of this form; None if it is none."""
        start = at + self.parts.size
        if start > len(region):
            return None
        before, first, between, second, behind, length = self.parts.unpack_from(region, at)
        if (before, between, behind) != self.around or length > len(region) - start:
            return None
        return (second, first, start, length) if self.turned else (first, second, start, length)


class Ros1Layout:
    """What is known of a bag's connections, and how its chunks are read."""

    overhead = 8 + _MESSAGE_HEADER

    def __init__(self) -> None:
        self.channels: dict[int, Channel] = {}

    def define(self, fields: dict[str, bytes], content: bytes) -> None:
        """Learn a connection.

        Raises:
            DamageError: the record is cut.
        """
        inner = {name: value.decode(errors="replace") for name, value in fields_of(content).items()}
        self.channels[number(fields, "conn", 4)] = Channel(
            resolved(fields["topic"].decode(errors="replace") if "topic" in fields else inner.get("topic", "")),
            inner.get("type", ""),
            inner.get("md5sum", ""),
            resolved(inner.get("callerid", "")),
            "",
            inner.get("message_definition", ""),
            "msg",
            "ros1",
        )

    def entries(self, region: bytes) -> list[Entries]:
        """Read the index records behind a chunk."""
        pieces = []
        at = 0
        form: _Form | None = None
        while at < len(region):
            known = form.read(region, at) if form is not None else None
            if known is None:
                fields, start, length = split(region, at)
                if operation(fields) != INDEX:
                    break
                channel, count = number(fields, "conn", 4), number(fields, "count", 4)
                form = _Form.of(region[at:start])
            else:
                channel, count, start, length = known
            at = start + length
            if count * 12 > length:
                raise DamageError(f"an index of {count:,} messages in a record of {length:,} bytes")
            if count:
                pieces.append((channel, region[start : start + count * 12]))
        if not pieces:
            return []
        table = np.frombuffer(b"".join([piece for _, piece in pieces]), "<u4").reshape(-1, 3)
        # Made wide before it is computed with: to compute across widths takes three times as long.
        times = table[:, 0].astype(np.int64)
        times *= _SECOND
        times += table[:, 1].astype(np.int64)
        return cut([(channel, len(piece) // 12) for channel, piece in pieces], times, table[:, 2].astype(np.int64))

    def locate(self, content: Bytes, offsets: Ints) -> tuple[Ints, Ints] | None:
        """Find messages by where their records begin."""
        if not len(offsets):
            return offsets, offsets
        if int(offsets.min()) < 0 or int(offsets.max()) > len(content) - self.overhead:
            return None
        right = numbers_at(content, offsets, np.uint32) == _MESSAGE_HEADER
        # The three fields come in any order; they are 8 (op), 13 (conn) and 17 (time) bytes long.
        operations = [numbers_at(content, offsets + 4 + place, np.uint64) == _OP for place in (0, 13, 17, 30)]
        right &= np.logical_or.reduce(operations)
        starts = offsets + self.overhead
        sizes = numbers_at(content, starts - 4, np.uint32).astype(np.int64)
        right &= sizes <= len(content) - starts
        return (starts, sizes) if bool(right.all()) else None

    def walk(self, content: bytes) -> Walk:
        """Read the records of a chunk."""
        rows = []
        at = 0
        stopped = ""
        while at < len(content):
            try:
                fields, start, length = split(content, at)
                kind = operation(fields)
                if kind == MESSAGE:
                    rows.append((number(fields, "conn", 4), time_of(fields, "time"), start, length))
                elif kind == CONNECTION:
                    self.define(fields, content[start : start + length])
            except DamageError as damage:
                stopped = str(damage)
                break
            at = start + length
        return walked(rows, stopped)


def split(content: bytes, at: int) -> tuple[dict[str, bytes], int, int]:
    """Return the header of the record at a place, and where its content begins and how long it is.

    Raises:
        DamageError: the record is cut.
    """
    end = len(content)
    if at + 4 > end:
        raise DamageError(f"{end - at} bytes at its end that are not a record")
    header = _U32.unpack_from(content, at)[0]
    if header > end - at - 8:
        raise DamageError(f"a header of {header:,} bytes where {end - at - 4:,} are left")
    length = _U32.unpack_from(content, at + 4 + header)[0]
    start = at + 8 + header
    if length > end - start:
        raise DamageError(f"a record of {length:,} bytes where {end - start:,} are left")
    return fields_of(content[at + 4 : at + 4 + header]), start, length
