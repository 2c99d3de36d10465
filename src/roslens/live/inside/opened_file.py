"""A counter file, open for reading; whose it is decides how it is read.

A file that is mapped must not become shorter: whoever reads behind its end is killed by the kernel (SIGBUS). A user
may do that to files of their own, and would end an agent that reads the counters of all users. So what belongs to
somebody else is never mapped but copied, which tells that it has become shorter.
"""

from __future__ import annotations

import fcntl
import mmap
import os
import struct
from pathlib import Path
from typing import Any

from roslens.live.inside import slots
from roslens.live.inside.snapshot import Snapshot, snapshot, text_at

_FIRST_TOKEN = slots.HEADER_BYTES // 8


class CutOffError(Exception):
    """A file became shorter while it was read."""


def open_file(path: Path, user: int | None = None) -> OpenedFile:
    """Open a counter file as ``user``, that of this process if None.

    Raises:
        OSError: it cannot be opened, or is a link.
        ValueError: it is no counter file of this version or a later one.
    """
    # Who reads for other users follows no links of theirs, and waits for no pipe.
    handle = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK)
    try:
        owner = os.fstat(handle).st_uid
        return (OpenedFile if owner == (os.getuid() if user is None else user) else ForeignFile)(path, handle)
    except BaseException:
        os.close(handle)
        raise


def _is_known(magic: bytes, version: int, slot_bytes: int) -> bool:
    """Return whether a file has at least what this version knows, and no slots that are too long to be copied."""
    return (
        magic == slots.MAGIC
        and version >= slots.VERSION
        and slots.SLOT_BYTES <= slot_bytes <= slots.MOST_SLOT_BYTES
        and slot_bytes % 8 == 0
    )


class OpenedFile:
    """One counter file of the user who reads it.

    Attributes:
        path: of the file.
        pid: of the process that counts, as it sees itself.
        started: when it did, in seconds since the epoch.
        host: name of its host.
        known: what the reader keeps of each slot.
        reported: what the reader last reported of the file's troubles.
        strange: whether it reported that the file has kinds of traffic that it does not know.
    """

    def __init__(self, path: Path, handle: int) -> None:
        self.path = path
        self._handle = handle
        size = os.fstat(handle).st_size
        self._map(size)
        header = self._header()
        if not _is_known(*header[:3]):
            self._unmap()
            raise ValueError(f"magic {header[0]!r}, version {header[1]}, slots of {header[2]} bytes")
        self._stride: int = header[2]
        self._most: int = min(header[3], (size - slots.HEADER_BYTES) // self._stride)
        self.pid: int = header[5]
        self.started: float = header[6] * 1e-9
        self.host = text_at(header[9], 0)
        self.known: list[Any] = []
        self.reported = ""
        self.strange = False

    @property
    def ended(self) -> bool:
        """Whether the process that wrote the file is gone."""
        try:
            fcntl.flock(self._handle, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except OSError:
            return False
        fcntl.flock(self._handle, fcntl.LOCK_UN)
        return True

    def tokens(self) -> list[int]:
        """Return of each slot in use the number that it has until somebody writes it.

        Raises:
            CutOffError: the file became shorter.
        """
        return self._words(slots.SEQUENCE)

    def generations(self) -> list[int]:
        """Return of each slot in use which endpoint of the process it is, counted from 1 for each slot.

        Raises:
            CutOffError: the file became shorter.
        """
        return self._words(slots.GENERATION)

    def slot(self, number: int, before: Snapshot | None) -> Snapshot | None:
        """Copy a slot, of which the last copy is ``before``.

        Raises:
            CutOffError: the file became shorter.
        """
        at = slots.HEADER_BYTES + number * self._stride
        return snapshot(self._view[at : at + self._stride], before)

    def trouble(self) -> str:
        """Return in words what keeps the hook from counting; empty if nothing does.

        Raises:
            CutOffError: the file became shorter.
        """
        header = self._header()
        state = text_at(header[10], 0)
        if "not counting" in state or "stopped" in state:
            return state
        return f"{header[8]} endpoints found no slot of {header[3]}" if header[8] else ""

    def close(self) -> None:
        """Let go of the file."""
        self._unmap()
        os.close(self._handle)

    def _header(self) -> tuple[Any, ...]:
        return slots.HEADER.unpack_from(self._view)

    def _words(self, at: int) -> list[int]:
        """Return one word of each slot in use."""
        used: int = struct.unpack_from("=I", self._view, slots.USED_AT)[0]
        words = self._stride // 8
        end = _FIRST_TOKEN + min(used, self._most) * words
        return self._numbers[_FIRST_TOKEN + at : end : words].tolist()

    def _map(self, size: int) -> None:
        if size < slots.HEADER_BYTES:
            raise ValueError(f"{size} bytes, expected at least {slots.HEADER_BYTES}")
        self._mapped = mmap.mmap(self._handle, size, prot=mmap.PROT_READ)
        self._view = memoryview(self._mapped)
        self._numbers = self._view[: size & ~7].cast("q")

    def _unmap(self) -> None:
        self._numbers.release()
        self._view.release()
        self._mapped.close()


class _Piece:
    """Bytes of a file, read anew whenever they are asked for."""

    def __init__(self, handle: int, at: int, size: int) -> None:
        self._handle, self._at, self._size = handle, at, size

    def __bytes__(self) -> bytes:
        found = os.pread(self._handle, self._size, self._at)
        if len(found) < self._size:
            raise CutOffError(f"it became shorter than {self._at + self._size:,} bytes while it was read")
        return found


class ForeignFile(OpenedFile):
    """One counter file of another user, of which nothing is believed: neither that it stays nor that it is small."""

    def slot(self, number: int, before: Snapshot | None) -> Snapshot | None:
        """See the other."""
        at = slots.HEADER_BYTES + number * self._stride
        return snapshot(_Piece(self._handle, at, self._stride), before)

    def _header(self) -> tuple[Any, ...]:
        header = slots.HEADER.unpack(bytes(_Piece(self._handle, 0, slots.HEADER.size)))
        return (*header[:3], min(header[3], slots.CAPACITY), *header[4:])

    def _words(self, at: int) -> list[int]:
        used: int = struct.unpack("=I", bytes(_Piece(self._handle, slots.USED_AT, 4)))[0]
        used = min(used, self._most)
        copied = memoryview(bytes(_Piece(self._handle, slots.HEADER_BYTES, used * self._stride))).cast("q")
        return copied[at :: self._stride // 8].tolist()

    def _map(self, size: int) -> None:
        if size < slots.HEADER_BYTES:
            raise ValueError(f"{size} bytes, expected at least {slots.HEADER_BYTES}")

    def _unmap(self) -> None:
        pass
