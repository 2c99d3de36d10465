"""A file that is read here and there, never beyond its end."""

from __future__ import annotations

import weakref
from pathlib import Path

from roslens.live.adapters.bag.damage import DamageError

_WINDOW = 1 << 13


class Source:
    """Bytes of a file by their place; the file is closed when nothing refers to this any more.

    Raises:
        OSError: the file cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._file = path.open("rb", buffering=0)
        weakref.finalize(self, self._file.close)
        self.size = self._file.seek(0, 2)
        self._window = b""
        self._window_at = 0

    def read(self, at: int, length: int) -> bytes:
        """Return bytes of the file.

        Raises:
            DamageError: the file ends before, or the system cannot read it.
        """
        if at < 0 or length < 0 or length > self.size - at:
            raise DamageError(f"{length:,} bytes at byte {at:,} of a file of {self.size:,}")
        if length > _WINDOW:
            return self._fetch(at, length)
        inside = at - self._window_at
        if inside < 0 or inside + length > len(self._window):
            self._window = self._fetch(at, min(_WINDOW, self.size - at))
            self._window_at, inside = at, 0
        return self._window[inside : inside + length]

    def fill(self, at: int, place: memoryview) -> None:
        """Put bytes of the file where they are wanted.

        Raises:
            DamageError: the file ends before, or the system cannot read it.
        """
        if at < 0 or len(place) > self.size - at:
            raise DamageError(f"{len(place):,} bytes at byte {at:,} of a file of {self.size:,}")
        try:
            self._file.seek(at)
            while len(place):
                taken = self._file.readinto(place)
                if not taken:
                    raise DamageError(f"a file that became shorter while it was read: {len(place):,} bytes are missing")
                place = place[taken:]
        except OSError as error:
            raise DamageError(f"bytes that cannot be read: {error.strerror or error}") from None

    def _fetch(self, at: int, length: int) -> bytes:
        pieces = []
        try:
            self._file.seek(at)
            while length:
                piece = self._file.read(length)
                if not piece:
                    raise DamageError(f"a file that became shorter while it was read: {length:,} bytes are missing")
                pieces.append(piece)
                length -= len(piece)
        except OSError as error:
            raise DamageError(f"bytes that cannot be read: {error.strerror or error}") from None
        return pieces[0] if len(pieces) == 1 else b"".join(pieces)
