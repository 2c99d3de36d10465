"""How observers speak to a monitor: frames of packed records with their length before them.

A frame is four bytes of length (big-endian), then a MessagePack array whose first element is the version of the
format. What cannot be read is an error with a reason; it never becomes a record. Tallies go by columns
(``model/traffic/tally_columns.py``), which are read in half the time of records; version 1 had records.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import msgspec

from roslens.model.believed import (
    MOST_CHARACTERS,
    MOST_COUNT,
    Refused,
    believed_events,
    believed_graph,
    believed_samples,
    quoted,
)
from roslens.model.failure import Failure
from roslens.model.graph import Event, Graph
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Tally
from roslens.model.traffic.tally_columns import Columns, TallyColumns, columns_of, fits

VERSION = 2
MAX_FRAME_BYTES = 16_000_000
_PREFIX = 4


class Frame(msgspec.Struct, frozen=True, array_like=True):
    """What an observer saw since its last frame.

    Attributes:
        version: of the format.
        sender: who speaks, unique per observer: ``<host>/<what it observes>``.
        sequence: number of the frame, from 0 on.
        time: seconds since the epoch on the sender's clock.
        tallies: traffic.
        samples: of hosts, processes and nodes.
        events: changes of the graph.
        graph: the whole graph, where it changed.
        failures: what could not be observed.
        shed: records that were dropped since the last frame because the line was down or the budget spent.
        counted_at: where the counters lie that the tallies were read from, the same for everybody who reads them, so
            that nothing is counted twice; empty where there are none.
        looked: up to when the sender has looked at all traffic that it observes, in seconds on its own clock, and
            reported what it saw with this frame or before; 0 where the frame says nothing of that. What no tally tells
            by then was silent; after it, nothing is known.
    """

    version: int
    sender: str
    sequence: int
    time: float
    tallies: Sequence[Tally] = []
    samples: list[Sample] = []
    events: list[Event] = []
    graph: Graph | None = None
    failures: list[Failure] = []
    shed: int = 0
    counted_at: str = ""
    looked: float = 0.0

    @property
    def vouched(self) -> float:
        """Up to when the sender has looked; without it, until it last reported traffic."""
        return self.looked or (self.time if self.tallies else 0.0)


class _Packed(msgspec.Struct, frozen=True, array_like=True):
    """A frame on the line: ``tallies`` has only those that columns cannot represent."""

    version: int
    sender: str
    sequence: int
    time: float
    tallies: list[Tally]
    samples: list[Sample]
    events: list[Event]
    graph: Graph | None
    failures: list[Failure]
    shed: int
    counted_at: str
    columns: Columns | None = None
    looked: float = 0.0

    @classmethod
    def of(cls, frame: Frame) -> _Packed:
        """Pack a frame."""
        fitting = [one for one in frame.tallies if fits(one)]
        others = [one for one in frame.tallies if not fits(one)] if len(fitting) < len(frame.tallies) else []
        return cls(
            frame.version, frame.sender, frame.sequence, frame.time, others, frame.samples, frame.events, frame.graph,
            frame.failures, frame.shed, frame.counted_at, columns_of(fitting) if fitting else None, frame.looked,
        )  # fmt: skip

    def frame(self) -> Frame:
        """Return the frame.

        Raises:
            ValueError: the columns do not fit together.
        """
        tallies: Sequence[Tally] = self.tallies
        if self.columns is not None:
            packed = TallyColumns(self.columns)
            tallies = [*packed, *tallies] if tallies else packed
        return Frame(
            self.version, self.sender, self.sequence, self.time, tallies, self.samples, self.events, self.graph,
            self.failures, self.shed, self.counted_at, self.looked,
        )  # fmt: skip


class WireError(ValueError):
    """Bytes that are not a frame; the text states what was found and expected."""


_ENCODER = msgspec.msgpack.Encoder()
_DECODER = msgspec.msgpack.Decoder(_Packed)


def encode_frame(frame: Frame) -> bytes:
    """Return a frame as it goes over a line."""
    body = _ENCODER.encode(_Packed.of(frame))
    return len(body).to_bytes(_PREFIX, "big") + body


def decode_frame(body: bytes) -> Frame:
    """Read a frame without its length; records that cannot be true are left out, and a failure names them.

    Raises:
        WireError: the bytes are no frame of this version, its time is not finite or its numbers are none, or who sent
            it has no name.
    """
    try:
        packed = _DECODER.decode(body)
        _refuse_version(packed.version)
        frame = packed.frame()
    except WireError:
        raise
    except (ValueError, RecursionError) as error:
        _refuse_version(_version_of(body))
        raise WireError(f"{len(body)} bytes that are not a frame: {error}") from None
    for name, value in (("time", frame.time), ("looked", frame.looked)):
        if not math.isfinite(value):
            raise WireError(f"a frame whose {name} is {value}, expected seconds since the epoch")
    if not 0 < len(frame.sender) <= MOST_CHARACTERS or len(frame.counted_at) > MOST_CHARACTERS:
        raise WireError(f"a frame from {quoted(frame.sender)}, expected a name")
    for number in (frame.sequence, frame.shed):
        if not 0 <= number <= MOST_COUNT:
            raise WireError(f"a frame with the number {number}, expected 0 or more")
    return _believed(frame)


def _believed(frame: Frame) -> Frame:
    refused = Refused()
    events = believed_events(frame.events, refused)
    samples = believed_samples(frame.samples, refused)
    graph = believed_graph(frame.graph, refused) if frame.graph is not None else None
    failures = refused.failures(frame.sender)
    if not failures:
        return frame
    return msgspec.structs.replace(
        frame, events=events, samples=samples, graph=graph, failures=[*frame.failures, *failures]
    )


def _refuse_version(version: int | None) -> None:
    if version not in (None, VERSION):
        raise WireError(f"a frame of version {version}, expected {VERSION}: update the older side")


def _version_of(body: bytes) -> int | None:
    """Return the version that an array begins with, None where there is none."""
    try:
        start = msgspec.msgpack.decode(body)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return None
    return start[0] if isinstance(start, list) and start and isinstance(start[0], int) else None


class FrameReader:
    """Cuts a stream of bytes, which may come in any pieces, into frames."""

    def __init__(self) -> None:
        self._waiting = bytearray()

    def feed(self, piece: bytes) -> Iterator[Frame]:
        """Add bytes and yield the frames that are complete.

        Raises:
            WireError: a frame is too long or no frame; nothing more can be read from the stream.
        """
        self._waiting += piece
        while len(self._waiting) >= _PREFIX:
            length = int.from_bytes(self._waiting[:_PREFIX], "big")
            if length > MAX_FRAME_BYTES:
                raise WireError(f"a frame of {length:,} bytes, expected at most {MAX_FRAME_BYTES:,}")
            if len(self._waiting) < _PREFIX + length:
                return
            body = bytes(self._waiting[_PREFIX : _PREFIX + length])
            del self._waiting[: _PREFIX + length]
            yield decode_frame(body)
