"""One connection to a publisher: what is read of it and what that becomes."""

from __future__ import annotations

import socket
from collections.abc import Callable
from enum import Enum

import msgspec

from roslens.live.adapters.ros1.accumulator import Accumulator
from roslens.live.adapters.ros1.statistics import LARGEST, StatisticsError, read_statistics
from roslens.live.adapters.ros1.wire.tcpros import HEAD_BYTES, Handshake, HeadReader
from roslens.model.traffic.tally import Tally

_PIECE = 65_536
_BIG = 8_192
"""Payloads above this are discarded by the kernel rather than copied and passed over."""
_AT_ONCE = 64
"""Reads of one stream before others have their turn."""
_MOST_WAITING = 10_000
_MOST_REPORTS = 100
_LARGEST_REPORT = 1_000_000


class Use(str, Enum):
    """What a connection is for."""

    TAP = "tap"
    STATISTICS = "statistics"
    REPORTS = "reports"


_WHOLE = {Use.STATISTICS: LARGEST, Use.REPORTS: _LARGEST_REPORT}


class Source(msgspec.Struct, frozen=True, order=True):
    """A publisher of a topic: its name, and the URI of its API."""

    use: Use
    topic: str
    publisher: str
    uri: str


class Drained(msgspec.Struct):
    """What one turn of reading found; ``open`` is False at the end of the stream."""

    messages: int = 0
    bytes: int = 0
    open: bool = True


class Stream:
    """Reads one connection without ever waiting."""

    def __init__(self, source: Source, line: socket.socket, handshake: Handshake, now: float, host: str) -> None:
        self.source = source
        self.line = line
        self.problem = ""
        self._host = host
        self._taps = source.use is Use.TAP
        self._reader = HeadReader(_WHOLE.get(source.use, HEAD_BYTES))
        self._accumulator = Accumulator(source.topic, source.publisher, handshake.stamped, now)
        self._reported: list[Tally] = []
        self._reports: list[tuple[float, bytes]] = []
        self._shed = 0
        self._piece = _PIECE
        self._waste = bytearray(262_144)

    def drain(self, clock: Callable[[], float]) -> Drained:
        """Read what is there.

        Raises:
            TcprosError: the stream is none of TCPROS.
        """
        found = Drained()
        try:
            for _ in range(_AT_ONCE):
                if self._taps and self._reader.left > _BIG:
                    size = min(self._reader.left, len(self._waste))
                    got = self.line.recv_into(self._waste, size, socket.MSG_TRUNC)
                    self._reader.left -= got
                    piece = b""
                else:
                    piece = self.line.recv(self._piece)
                    got = len(piece)
                if not got:
                    found.open = False
                    break
                found.bytes += got
                if piece:
                    found.messages += self._heads(self._reader.feed(piece), clock())
                    if got < self._piece and not self._reader.left:
                        break
        except BlockingIOError:
            pass
        except OSError:
            found.open = False
        return found

    def _heads(self, begun: list[tuple[int, bytes]], now: float) -> int:
        for size, head in begun:
            if self._taps:
                self._accumulator.message(size, head, now)
            elif self.source.use is Use.REPORTS:
                self._report(size, head, now)
            else:
                self._statistics(head, now)
        if begun and self._taps:
            self._piece = 4 + HEAD_BYTES if begun[-1][0] > _BIG else _PIECE
        return len(begun)

    def _statistics(self, body: bytes, now: float) -> None:
        if len(self._reported) >= _MOST_WAITING:
            self._shed += 1
            return
        try:
            self._reported.append(read_statistics(body, now, self._host))
        except StatisticsError as error:
            self.problem = f"{self.source.publisher} sends no statistics: {error}"

    def _report(self, size: int, body: bytes, now: float) -> None:
        if len(body) < size:
            self.problem = f"{self.source.publisher} sends {size:,} bytes at once, which are passed over"
        elif len(self._reports) < _MOST_REPORTS:
            self._reports.append((now, body))
        else:
            self._shed += 1

    def reports(self) -> list[tuple[float, bytes]]:
        """Return messages of other monitors that came since the last time, and when."""
        reports, self._reports = self._reports, []
        return reports

    def take(self, now: float) -> tuple[list[Tally], int]:
        """Return what came since the last time, and how many records were dropped."""
        if self._taps:
            return [self._accumulator.take(now, self._host)], 0
        reported, shed = self._reported, self._shed
        self._reported, self._shed = [], 0
        return reported, shed
