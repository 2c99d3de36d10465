"""Files of ``/proc`` and ``/sys`` that are read again and again, kept open: a read is then one system call."""

from __future__ import annotations

import os
from pathlib import Path

_PIECE = 65_536


class KeptOpen:
    """A small file that is read from its start each time; opened at the first read and after a fault."""

    def __init__(self, path: Path) -> None:
        """Keep ``path``; nothing is opened yet."""
        self._path = path
        self._file = -1

    def read(self) -> bytes | None:
        """Return what the file holds now, None where it is not there or cannot be read."""
        for _ in range(2):
            try:
                if self._file < 0:
                    self._file = os.open(self._path, os.O_RDONLY | os.O_CLOEXEC)
                return self._all()
            except OSError:
                # A process that ended keeps its open files unreadable; one with its number may have come since.
                self.close()
        return None

    def close(self) -> None:
        """Let the file go."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1

    def _all(self) -> bytes:
        found = os.pread(self._file, _PIECE, 0)
        if len(found) < _PIECE:
            return found
        pieces, at = [found], len(found)
        while piece := os.pread(self._file, _PIECE, at):
            pieces.append(piece)
            at += len(piece)
        return b"".join(pieces)
