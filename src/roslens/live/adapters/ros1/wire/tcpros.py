"""TCPROS: the handshake that begins a connection to a publisher, and messages cut from its stream."""

from __future__ import annotations

import re
import socket
import time
from collections.abc import Mapping

import msgspec

LARGEST_HEADER = 4_000_000
LARGEST_MESSAGE = 2**30
HEAD_BYTES = 12
"""Of a message that begins with a header: sequence number, seconds and nanoseconds of its stamp."""
_MOST_FIELDS = 100
_HEADER_FIELD = re.compile(r"(std_msgs/|roslib/)?Header\s+\w+\s*$")


class TcprosError(Exception):
    """The data is not TCPROS, or the publisher refuses; the text states what was found."""


class Handshake(msgspec.Struct, frozen=True):
    """The connection header of a publisher, which precedes its first message.

    Attributes:
        caller: name of the publishing node.
        type: of its messages.
        md5: of their definition.
        stamped: whether they begin with sequence number and stamp.
    """

    caller: str = ""
    type: str = ""
    md5: str = ""
    stamped: bool = False


def encode_header(fields: Mapping[str, str]) -> bytes:
    """Return fields as they go over a line, with their length before them."""
    packed = b"".join(
        len(pair).to_bytes(4, "little") + pair for pair in (f"{key}={value}".encode() for key, value in fields.items())
    )
    return len(packed).to_bytes(4, "little") + packed


def decode_header(body: bytes) -> dict[str, str]:
    """Read fields without the length before them.

    Raises:
        TcprosError: they are none.
    """
    fields: dict[str, str] = {}
    place = 0
    while place < len(body):
        size = int.from_bytes(body[place : place + 4], "little")
        pair = body[place + 4 : place + 4 + size]
        key, equals, value = pair.partition(b"=")
        if len(pair) != size or not equals or len(fields) >= _MOST_FIELDS:
            raise TcprosError(f"a header with {bytes(body[place : place + 40])!r}, expected fields key=value")
        fields[key.decode(errors="replace")] = value.decode(errors="replace")
        place += 4 + size
    return fields


def is_stamped(type_: str, definition: str) -> bool:
    """Whether messages of a definition begin with a header; also where they are headers themselves."""
    if type_ == "std_msgs/Header":
        return True
    for line in definition.split("\n=====", 1)[0].splitlines():
        field = line.partition("#")[0].strip()
        if field and ("=" not in field or field.startswith("Header")):
            return bool(_HEADER_FIELD.match(field))
    return False


def connect(address: str, port: int, topic: str, caller: str, wait_s: float) -> tuple[socket.socket, Handshake]:
    """Connect to a publisher and return the line, at its first message, and the header of the publisher.

    Raises:
        TcprosError: the publisher refuses, or does not speak TCPROS.
        OSError: there is no way to it, or it does not answer in time.
    """
    end = time.monotonic() + wait_s
    line = socket.create_connection((address, port), timeout=wait_s)
    try:
        header = _shake_hands(line, topic, caller, end)
        line.setblocking(False)
    except BaseException:
        line.close()
        raise
    type_ = header.get("type", "")[:300]
    stamped = is_stamped(type_, header.get("message_definition", ""))
    return line, Handshake(header.get("callerid", "")[:1024], type_, header.get("md5sum", "")[:64], stamped)


def _shake_hands(line: socket.socket, topic: str, caller: str, end: float) -> dict[str, str]:
    # The wildcards let a publisher of any type accept.
    fields = {"callerid": caller, "topic": topic, "type": "*", "md5sum": "*", "message_definition": ""}
    line.sendall(encode_header({**fields, "tcp_nodelay": "1"}))
    size = int.from_bytes(_exactly(line, 4, end), "little")
    if size > LARGEST_HEADER:
        raise TcprosError(f"a header of {size:,} bytes, expected at most {LARGEST_HEADER:,}")
    header = decode_header(_exactly(line, size, end))
    if "error" in header:
        raise TcprosError(f"the publisher refuses: {header['error'][:200]}")
    return header


def _exactly(line: socket.socket, size: int, end: float) -> bytes:
    came = bytearray()
    while len(came) < size:
        left = end - time.monotonic()
        if left <= 0:
            raise TimeoutError("no answer to the handshake in time")
        line.settimeout(left)
        piece = line.recv(min(size - len(came), 65_536))
        if not piece:
            raise TcprosError("the publisher hung up during the handshake")
        came += piece
    return bytes(came)


class HeadReader:
    """Cuts a stream, in any pieces, into sizes and heads of messages; payloads are passed over.

    Attributes:
        left: bytes of the newest message that have not come yet, which may be discarded unread.
    """

    def __init__(self, head: int = HEAD_BYTES) -> None:
        self.left = 0
        self._head = head
        self._kept = b""

    def feed(self, piece: bytes) -> list[tuple[int, bytes]]:
        """Add bytes; return size and head of each message that began.

        Raises:
            TcprosError: a message is longer than any is.
        """
        data = self._kept + piece if self._kept else piece
        place, end = 0, len(data)
        begun: list[tuple[int, bytes]] = []
        while True:
            if self.left:
                step = min(self.left, end - place)
                place += step
                self.left -= step
            if end - place < 4 or self.left:
                break
            size = int.from_bytes(data[place : place + 4], "little")
            if size > LARGEST_MESSAGE:
                raise TcprosError(f"a message of {size:,} bytes, expected at most {LARGEST_MESSAGE:,}")
            head = min(size, self._head)
            if end - place < 4 + head:
                break
            begun.append((size, data[place + 4 : place + 4 + head]))
            place += 4 + head
            self.left = size - head
        self._kept = data[place:]
        return begun
