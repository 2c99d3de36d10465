"""The counter file of one process: created, filled with slots, released; ``slots`` defines its layout.

Loaded in the node's own Python, see the package.
"""

from __future__ import annotations

import contextlib
import fcntl
import mmap
import os
import socket
import stat
import struct
import tempfile
import threading
import time
from collections import deque
from pathlib import Path

from .slots import (
    CAPACITY,
    FAULTS_AT,
    HEADER,
    HEADER_BYTES,
    MAGIC,
    OVERFLOW_AT,
    REST_NS,
    SLOT_BYTES,
    STALE_NS,
    STATE_AT,
    STATE_BYTES,
    SUFFIX,
    USED_AT,
    VERSION,
    Slot,
)


def make_folder(folder: str) -> None:
    """Make the folder, for its user alone.

    Raises:
        PermissionError: it is a link, no folder, or somebody else's.
    """
    Path(folder).mkdir(mode=0o700, parents=True, exist_ok=True)
    found = Path(folder).lstat()
    if not stat.S_ISDIR(found.st_mode) or found.st_uid != os.getuid():
        raise PermissionError(f"{folder} is not a folder of the user {os.getuid()}")


class CounterFile:
    """The counter file of this process, which ends with the process."""

    def __init__(self, folder: str, capacity: int = CAPACITY) -> None:
        make_folder(folder)
        size = HEADER_BYTES + capacity * SLOT_BYTES
        handle, hidden = tempfile.mkstemp(prefix=".", dir=folder)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            os.ftruncate(handle, size)
            # The map keeps a file open that is opened for it alone: the lock shall end with the other one.
            with Path(hidden).open("r+b") as file:
                self._map = mmap.mmap(file.fileno(), size)
            HEADER.pack_into(
                self._map, 0, MAGIC, VERSION, SLOT_BYTES, capacity, 0, os.getpid(), time.time_ns(), 0, 0,
                socket.gethostname().encode()[:63], b"",
            )  # fmt: skip
            self.path = Path(folder, f"{os.getpid()}-{Path(hidden).name[1:]}{SUFFIX}")
            Path(hidden).rename(self.path)
        except BaseException:
            os.close(handle)
            Path(hidden).unlink()
            raise
        self._handle = handle
        self._view = memoryview(self._map)
        self._slots: list[Slot] = []
        self._ended: deque[tuple[int, Slot]] = deque()
        self._gone: deque[tuple[int, list[Slot]]] = deque()
        self._lock = threading.Lock()
        self._capacity = capacity

    def slot(self, kind: int, gid: bytes, topic: str, node: str, other: str = "", now: int = 0) -> Slot | None:
        """Return a slot for an endpoint; None where all are taken by endpoints of the last minute."""
        with self._lock:
            self._end_gone()
            used = len(self._slots) + len(self._ended)
            words = self._rested(now)
            if words is None and used < self._capacity:
                at = HEADER_BYTES + used * SLOT_BYTES
                words = self._view[at : at + SLOT_BYTES]
            if words is None:
                words = self._stale(now)
            if words is None:
                self._write("=Q", OVERFLOW_AT, self._read("=Q", OVERFLOW_AT) + 1)
                return None
            slot = Slot(words)
            slot.begin(kind, gid, topic, node, other)
            self._slots.append(slot)
            self._write("=I", USED_AT, max(self._read("=I", USED_AT), len(self._slots) + len(self._ended)))
            return slot

    def end(self, of: list[Slot], now: int) -> None:
        """Note that an endpoint was destroyed. May be called by the garbage collector, at any time in any thread."""
        self._gone.append((now, of))
        if self._lock.acquire(blocking=False):
            try:
                self._end_gone()
            finally:
                self._lock.release()

    def _end_gone(self) -> None:
        while self._gone:
            now, slots = self._gone.popleft()
            for slot in slots:
                if not slot.left:
                    self._slots.remove(slot)
                    slot.end(now)
                    self._ended.append((now, slot))

    def _rested(self, now: int) -> memoryview | None:
        """Return the words of an endpoint that ended so long ago that they were read."""
        if not self._ended or 0 <= now - self._ended[0][0] < REST_NS:
            return None
        return self._ended.popleft()[1].leave()

    def _stale(self, now: int) -> memoryview | None:
        """Return the words of the endpoint that has been silent for longest; None if that is not long."""
        oldest = min(self._slots, key=lambda slot: slot.last, default=None)
        if oldest is None or oldest.last + STALE_NS >= now:
            return None
        self._slots.remove(oldest)
        return oldest.leave()

    def say(self, state: str) -> None:
        """Write the state of the hook, in words."""
        self._map[STATE_AT : STATE_AT + STATE_BYTES] = state.encode("utf-8", "replace")[: STATE_BYTES - 1].ljust(
            STATE_BYTES, b"\0"
        )

    def fault(self) -> None:
        """Count an error of the hook itself."""
        self._write("=Q", FAULTS_AT, self._read("=Q", FAULTS_AT) + 1)

    def close(self) -> None:
        """Let go of the file and take it away; who has it open can still read it."""
        with contextlib.suppress(OSError):
            self.path.unlink()
        self.release()

    def release(self) -> None:
        """Let go of the lock without taking the file away."""
        if self._handle >= 0:
            os.close(self._handle)
            self._handle = -1

    def _write(self, form: str, at: int, value: int) -> None:
        struct.pack_into(form, self._map, at, value)

    def _read(self, form: str, at: int) -> int:
        return int(struct.unpack_from(form, self._map, at)[0])
