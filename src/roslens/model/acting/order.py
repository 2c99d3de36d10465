"""What a monitor asks of those who act for it, and what they answer: frames on a line between processes of one host.

A frame is four bytes of length (big-endian), then a MessagePack array whose first element is the version of the format.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum
from typing import Any, Generic, TypeVar

import msgspec

VERSION = 1
MAX_BYTES = 1_000_000
_PREFIX = 4


class Verb(str, Enum):
    """What is asked.

    - prepare: say whether it could be done, and get ready to do it at once
    - do: do it
    - clear: what it was done about is gone; end what repeats
    - stop: end everything that is under way
    """

    PREPARE = "prepare"
    DO = "do"
    CLEAR = "clear"
    STOP = "stop"


class Order(msgspec.Struct, frozen=True, array_like=True):
    """One thing that is asked.

    Attributes:
        version: of the format.
        id: of the decision, by which the answer is known.
        verb: what is asked.
        kind: key of the action.
        target: name of the entity that it is done to, empty where it has none.
        arguments: of the action, defaults filled in.
    """

    version: int
    id: str
    verb: Verb
    kind: str = ""
    target: str = ""
    arguments: dict[str, Any] = {}


class Reply(msgspec.Struct, frozen=True, array_like=True):
    """The answer to an order that was to be prepared or done.

    Attributes:
        version: of the format.
        id: of the order.
        verb: of the order.
        done: whether it was, or could be.
        text: what was done, or why it was not.
        duration_s: how long it took.
    """

    version: int
    id: str
    verb: Verb
    done: bool
    text: str = ""
    duration_s: float = 0.0


class OrderError(ValueError):
    """Bytes that are not a frame; the text states what was found and expected."""


_ENCODER = msgspec.msgpack.Encoder()
_Read = TypeVar("_Read", Order, Reply)


def encode_order(frame: Order | Reply) -> bytes:
    """Return a frame as it goes over a line.

    Raises:
        OrderError: it is longer than a reader takes.
    """
    try:
        body = _ENCODER.encode(frame)
    except (TypeError, ValueError, OverflowError) as error:
        raise OrderError(f"the request cannot be sent: {error}") from None
    if len(body) > MAX_BYTES:
        raise OrderError(f"an order of {len(body):,} bytes, expected at most {MAX_BYTES:,}")
    return len(body).to_bytes(_PREFIX, "big") + body


class OrderReader(Generic[_Read]):
    """Cuts a stream of bytes, which may come in any pieces, into frames of one type."""

    def __init__(self, type_: type[_Read]) -> None:
        """Read orders, or replies."""
        self._decoder: msgspec.msgpack.Decoder[_Read] = msgspec.msgpack.Decoder(type_)
        self._waiting = bytearray()

    def feed(self, piece: bytes) -> Iterator[_Read]:
        """Add bytes and yield the frames that are complete.

        Raises:
            OrderError: a frame is too long, of another version or no frame; nothing more can be read.
        """
        self._waiting += piece
        while len(self._waiting) >= _PREFIX:
            length = int.from_bytes(self._waiting[:_PREFIX], "big")
            if length > MAX_BYTES:
                raise OrderError(f"a frame of {length:,} bytes, expected at most {MAX_BYTES:,}")
            if len(self._waiting) < _PREFIX + length:
                return
            body = bytes(self._waiting[_PREFIX : _PREFIX + length])
            del self._waiting[: _PREFIX + length]
            try:
                frame = self._decoder.decode(body)
            except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
                raise OrderError(f"{len(body)} bytes that are not an order of version {VERSION}: {error}") from None
            if frame.version != VERSION:
                raise OrderError(f"an order of version {frame.version}, expected {VERSION}: update the older side")
            yield frame
