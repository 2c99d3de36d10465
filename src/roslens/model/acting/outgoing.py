"""What a monitor asks its observers to publish in ROS: frames that go the other way, towards the observer.

A frame is four bytes of length (big-endian), then a MessagePack array whose first element is the version of the
format, as in :mod:`roslens.model.wire`.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

VERSION = 1
MAX_BYTES = 4_000_000
_PREFIX = 4
_NAN = float("nan")


class Status(msgspec.Struct, frozen=True, array_like=True):
    """A diagnostic_msgs/DiagnosticStatus."""

    level: int
    name: str
    message: str
    hardware_id: str
    values: tuple[tuple[str, str], ...]


class RatedSignal(msgspec.Struct, frozen=True, array_like=True):
    """A roslens_msgs/RatedSignal; fields and units are those of its definition."""

    kind: str
    name: str
    constraint: str
    quantity: str
    unit: str
    value: float
    low: float
    high: float
    state: int
    since: float
    severity: int
    cause: str
    evidence: str
    text: str


class ConnectionStatistics(msgspec.Struct, frozen=True, array_like=True):
    """A roslens_msgs/ConnectionStatistics; fields and units are those of its definition."""

    topic: str
    publisher: str
    subscriber: str
    rate: float = _NAN
    bandwidth: float = _NAN
    period: float = _NAN
    jitter: float = _NAN
    largest_gap: float = _NAN
    latency: float = _NAN
    latency_max: float = _NAN
    age: float = _NAN
    drops: float = _NAN


class RatedSignals(msgspec.Struct, frozen=True, array_like=True):
    """A roslens_msgs/RatedSignals without its header."""

    monitor: str
    complete: bool
    part: int
    parts: int
    signals: tuple[RatedSignal, ...]
    connections: tuple[ConnectionStatistics, ...]


class Outgoing(msgspec.Struct, frozen=True, array_like=True):
    """One message to publish on each topic for which there is something.

    Attributes:
        version: of the format.
        time: of the look at the system, in seconds since the epoch.
        statuses: of a diagnostic_msgs/DiagnosticArray; None for no message.
        rated: None for no message.
    """

    version: int
    time: float
    statuses: tuple[Status, ...] | None = None
    rated: RatedSignals | None = None


class OutgoingError(ValueError):
    """Bytes that are not a frame; the text states what was found and expected."""


_ENCODER = msgspec.msgpack.Encoder()
_DECODER = msgspec.msgpack.Decoder(Outgoing)


def encode_outgoing(frame: Outgoing) -> bytes:
    """Return a frame as it goes over a line.

    Raises:
        OutgoingError: it is longer than a reader takes.
    """
    body = _ENCODER.encode(frame)
    if len(body) > MAX_BYTES:
        raise OutgoingError(f"{len(body):,} bytes to publish at once, expected at most {MAX_BYTES:,}")
    return len(body).to_bytes(_PREFIX, "big") + body


class OutgoingReader:
    """Cuts a stream of bytes, which may come in any pieces, into frames."""

    def __init__(self) -> None:
        self._waiting = bytearray()

    def feed(self, piece: bytes) -> Iterator[Outgoing]:
        """Add bytes and yield the frames that are complete.

        Raises:
            OutgoingError: a frame is too long, of another version or no frame; nothing more can be read.
        """
        self._waiting += piece
        while len(self._waiting) >= _PREFIX:
            length = int.from_bytes(self._waiting[:_PREFIX], "big")
            if length > MAX_BYTES:
                raise OutgoingError(f"a frame of {length:,} bytes, expected at most {MAX_BYTES:,}")
            if len(self._waiting) < _PREFIX + length:
                return
            body = bytes(self._waiting[_PREFIX : _PREFIX + length])
            del self._waiting[: _PREFIX + length]
            yield _decoded(body)


def _decoded(body: bytes) -> Outgoing:
    try:
        frame = _DECODER.decode(body)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise OutgoingError(f"{len(body)} bytes that are not a frame of version {VERSION}: {error}") from None
    if frame.version != VERSION:
        raise OutgoingError(f"a frame of version {frame.version}, expected {VERSION}: update the older side")
    return frame
