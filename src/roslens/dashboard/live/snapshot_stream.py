"""The stream of a page: a whole snapshot for readers that are new or fell behind, changes for all others.

Each piece is encoded once for all readers.
"""

from __future__ import annotations

import secrets
from collections import deque
from collections.abc import Callable
from typing import NamedTuple

import msgspec

from roslens.dashboard.live.changes import change, held
from roslens.dashboard.live.snapshot import UNJUDGED, VERSION, Picture, Snapshot

MOST_KEPT = 240
"""Changes that are kept for readers that reconnect: a minute of four a second."""
MOST_BYTES = 2_000_000
"""Of kept changes; readers that are further behind get the whole snapshot."""


NOTHING = Snapshot(VERSION, 0.0, "", "", True, UNJUDGED, {}, "", (), (), (), Picture(), (), ())
"""The snapshot before anything was observed."""


class Piece(NamedTuple):
    """The change from the previous state to the one with this number, as a part of a stream."""

    number: int
    text: bytes


class SnapshotStream:
    """Numbers snapshots, and encodes the changes between them; for use in one thread."""

    def __init__(self, state: Callable[[], Snapshot | None]) -> None:
        """Stream the results of ``state``: the same object while nothing is new, None before the first snapshot."""
        self._state = state
        self._begun = secrets.token_hex(4)
        self._newest: Snapshot | None = None
        self._number = 0
        self._kept: deque[Piece] = deque()
        self._bytes = 0
        self._whole = b""
        self._size = 0

    def look(self) -> int:
        """Return the number of the newest snapshot."""
        newest = self._state()
        if newest is self._newest or newest is None:
            return self._number
        before, self._newest = self._newest, newest
        self._number += 1
        self._whole = b""
        found = change(before, newest) if before is not None else None
        if found is None:
            self._kept.clear()
            self._bytes = 0
        else:
            self._keep(Piece(self._number, self._part("change", msgspec.json.encode(found))))
        return self._number

    def mark(self) -> str:
        """Return the mark with which a page that has the newest snapshot continues."""
        return f"{self._begun}.{self._number}"

    def number_of(self, mark: str) -> int:
        """Return the number of the snapshot with a mark; 0 if the mark is not of this stream."""
        begun, _, number = mark.partition(".")
        known = begun == self._begun and number.isascii() and number.isdigit() and len(number) < 16
        return int(number) if known and int(number) <= self._number else 0

    def since(self, number: int) -> bytes:
        """Return what a reader with the snapshot of a number lacks; empty if that is nothing."""
        if number == self._number:
            return b""
        missed = [piece.text for piece in self._kept if piece.number > number]
        if number and len(missed) == self._number - number and (not self._size or sum(map(len, missed)) < self._size):
            return b"".join(missed)
        return self.whole()

    def newest(self) -> Snapshot:
        """Return the newest snapshot as pages have it; an empty one before the first."""
        return held(self._newest or NOTHING)

    def newest_lives(self) -> bool:
        """Return whether a newer snapshot will come."""
        return self._newest is not None and self._newest.live

    def whole(self) -> bytes:
        """Return all of the newest snapshot."""
        if not self._whole and self._newest is not None:
            self._whole = self._part("state", msgspec.json.encode(held(self._newest)))
            self._size = len(self._whole)
        return self._whole

    def _part(self, name: str, text: bytes) -> bytes:
        return f"id: {self.mark()}\nevent: {name}\ndata: ".encode() + text + b"\n\n"

    def _keep(self, piece: Piece) -> None:
        self._kept.append(piece)
        self._bytes += len(piece.text)
        while self._kept and (len(self._kept) > MOST_KEPT or self._bytes > MOST_BYTES):
            self._bytes -= len(self._kept.popleft().text)
