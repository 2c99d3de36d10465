"""Writes messages as MCAP without chunks: what is written can be read even where the end is missing.

The format is that of https://mcap.dev/spec.
"""

from __future__ import annotations

import struct
from typing import BinaryIO

_MAGIC = b"\x89MCAP0\r\n"
_HEADER, _FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _DATA_END = 0x01, 0x02, 0x03, 0x04, 0x05, 0x0F
_RECORD = struct.Struct("<BQ")
_OF_MESSAGE = struct.Struct("<HIQQ")


class McapWriter:
    """Writes one file; channels are numbered from 0 on."""

    def __init__(self, stream: BinaryIO, profile: str) -> None:
        """Begin a file of ``profile`` ``ros1`` or ``ros2``."""
        self._stream = stream
        stream.write(_MAGIC)
        self._record(_HEADER, _text(profile) + _text("roslens"))
        self._channels = 0

    def channel(
        self, topic: str, type_: str, language: str, definition: str, encoding: str, more: dict[str, str]
    ) -> int:
        """Write a channel with its schema; return its number."""
        number, self._channels = self._channels, self._channels + 1
        body = definition.encode("utf-8", "replace")
        schema = struct.pack("<H", number + 1) + _text(type_) + _text(language) + struct.pack("<I", len(body)) + body
        self._record(_SCHEMA, schema)
        pairs = b"".join(_text(key) + _text(value) for key, value in more.items())
        table = struct.pack("<I", len(pairs)) + pairs
        self._record(_CHANNEL, struct.pack("<HH", number, number + 1) + _text(topic) + _text(encoding) + table)
        return number

    def message(self, channel: int, sequence: int, time_ns: int, body: bytes) -> None:
        """Write a message that came at a time in nanoseconds since the epoch."""
        self._record(_MESSAGE, _OF_MESSAGE.pack(channel, sequence % 2**32, time_ns, time_ns) + body)

    def end(self) -> None:
        """Write the end of the file."""
        self._record(_DATA_END, struct.pack("<I", 0))
        self._record(_FOOTER, struct.pack("<QQI", 0, 0, 0))
        self._stream.write(_MAGIC)

    def _record(self, kind: int, body: bytes) -> None:
        self._stream.write(_RECORD.pack(kind, len(body)) + body)


def _text(text: str) -> bytes:
    encoded = text.encode("utf-8", "replace")
    return struct.pack("<I", len(encoded)) + encoded
