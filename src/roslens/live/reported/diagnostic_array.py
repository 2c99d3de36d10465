"""A serialised diagnostic_msgs/DiagnosticArray of ROS 1 or ROS 2: names and levels are read, values passed over."""

from __future__ import annotations

from typing import Literal

from roslens.live.reported.reported_levels import Report

MOST = 10_000
"""Statuses of one message."""


class ArrayError(ValueError):
    """Bytes that are no diagnostic_msgs/DiagnosticArray."""


class _Reader:
    """Goes through bytes; in ``cdr``, which ROS 2 uses, lengths are aligned and texts end with a zero."""

    def __init__(self, body: bytes, *, cdr: bool) -> None:
        self._body = body
        self._cdr = cdr
        self._begin = 4 if cdr else 0
        self._order: Literal["big", "little"] = "big" if cdr and body[1:2] == b"\x00" else "little"
        self.place = self._begin

    def length(self) -> int:
        if self._cdr:
            self.place += -(self.place - self._begin) % 4
        found = int.from_bytes(self._body[self.place : self.place + 4], self._order)
        self.place += 4
        if self.place > len(self._body):
            raise ArrayError(f"{len(self._body):,} bytes, which end where a length should be")
        return found

    def skip(self) -> int:
        size = self.length()
        self.place += size
        if self.place > len(self._body):
            raise ArrayError(f"a text of {size:,} bytes within {len(self._body):,}")
        return size

    def text(self) -> str:
        size = self.skip()
        end = self.place - 1 if self._cdr and size else self.place
        return self._body[self.place - size : end].decode(errors="replace")

    def byte(self) -> int:
        self.place += 1
        if self.place > len(self._body):
            raise ArrayError(f"{len(self._body):,} bytes, which end where a level should be")
        return self._body[self.place - 1]


def read_array(body: bytes, *, cdr: bool) -> list[Report]:
    """Return the statuses of a message, without their values.

    Args:
        body: as it was sent.
        cdr: whether it is of ROS 2.

    Raises:
        ArrayError: the bytes are none.
    """
    reader = _Reader(body, cdr=cdr)
    reader.place += 8 if cdr else 12
    reader.skip()
    number = reader.length()
    if number > MOST:
        raise ArrayError(f"{number:,} statuses in {len(body):,} bytes, expected at most {MOST:,}")
    reports = []
    for _ in range(number):
        level, name, message, hardware = reader.byte(), reader.text(), reader.text(), reader.text()
        pairs = reader.length()
        if pairs > len(body):
            raise ArrayError(f"{pairs:,} values in {len(body):,} bytes")
        for _ in range(2 * pairs):
            reader.skip()
        reports.append(Report(name, level, message, hardware))
    return reports
