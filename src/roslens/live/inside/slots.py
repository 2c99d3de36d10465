"""Counters of one process in a file in shared memory: one process writes without locks, anyone reads at any time.

All numbers have the byte order of the machine and lie on multiples of eight bytes, so that a program in any language
can write the file. A header of 4096 bytes is followed by slots of 3584 bytes, one for each kind of traffic of each
endpoint. ``used`` in the header grows after a slot has been filled in.

A slot begins and ends with the same even number while nobody writes it. A writer makes the first odd, writes, then
makes both the next even number; a reader that finds them different, or odd, reads again.

Counters only grow, so that any number of readers can take differences at their own pace and none needs to write. Least
and greatest cannot be had from a difference: they lie in a ring of 32 banks, of which the writer takes the next every
0.27 s in which there is traffic. A reader takes the extremes of the banks begun since its last read, and of the bank
that was current then those that changed: each extreme is told once, to every reader that reads at least every 8.5 s.

The process holds an advisory lock (``flock``) on the file; the lock of a process that ended, however it ended, is free.
"""

from __future__ import annotations

import array
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
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .sequence import Sequence

MAGIC = b"RLCOUNTS"
VERSION = 1
SUFFIX = ".counters"
VARIABLE = "ROSLENS_COUNTERS"

HEADER_BYTES = 4096
HEADER = struct.Struct("=8sIIIIQqQQ64s128s")
"""Magic, version, bytes of a slot, capacity, used, pid, start in ns since the epoch, faults of the hook, endpoints that
found no slot, name of the host, state of the hook in words."""
USED_AT = 20
FAULTS_AT = 40
OVERFLOW_AT = 48
STATE_AT = 120
STATE_BYTES = 128

WORDS = 448
SLOT_BYTES = WORDS * 8
CAPACITY = 1024

TAKEN, PUBLISHED, ANSWERED = 1, 2, 3
"""Kinds: taken from a publisher; published; published in answer to a message of the topic ``other``."""
REQUESTED, HEARD, ASKED, REPLIED = 4, 5, 6, 7
"""Kinds of a service, whose name is the topic: requests a client sent, responses it took, requests a server took,
responses it sent. The preloaded library alone counts them; processing is the time of a call, for client and server."""

SEQUENCE, KIND, GENERATION, GID = 0, 1, 2, 3
COUNT, BYTES, FIRST, LAST, LOST, PENDING, PENDING_SINCE, BANK = 6, 7, 8, 9, 10, 11, 12, 13
PERIOD, LATENCY, AGE, PROCESSING = 14, 17, 20, 23
"""Each of the four is count, sum in seconds, sum of squares."""
BANKS_AT = 32
BANKS = 32
BANK_WORDS = 8
"""Least and greatest of period, latency, age and processing, in seconds."""
BANK_SHIFT = 28
TOPIC, NODE, OTHER = 288, 320, 352
NAME_BYTES = 256
END = WORDS - 1

STALE_NS = 60_000_000_000
_NOTHING_YET = (float("inf"), float("-inf")) * 4
_SHAPE = struct.Struct("@2q")
_RARE = struct.Struct("@4q")
"""What seldom changes goes into the piece as bytes that were packed before: each number costs as much as a write."""
_write_counters = struct.Struct("@q16sq32sqddqdd").pack_into
_write_aged = struct.Struct("@q16sq32sqddqddqdd").pack_into
_write_answers = struct.Struct("@q16sq32s72sqdd").pack_into
_NO_MOMENTS = bytes(72)
_EXTREMES = struct.Struct("=8d")


def folder_of(environment: Mapping[str, str], uid: int | None = None) -> str:
    """Return the folder of counter files that an environment names.

    Args:
        environment: variables by name.
        uid: number of the user; that of this process if None.
    """
    return environment.get(VARIABLE) or f"/dev/shm/roslens-{os.getuid() if uid is None else uid}"  # noqa: S108 - the folder is looked at before use


def make_folder(folder: str) -> None:
    """Make the folder, for its user alone.

    Raises:
        PermissionError: it is a link, no folder, or somebody else's.
    """
    Path(folder).mkdir(mode=0o700, parents=True, exist_ok=True)
    found = Path(folder).lstat()
    if not stat.S_ISDIR(found.st_mode) or found.st_uid != os.getuid():
        raise PermissionError(f"{folder} is not a folder of the user {os.getuid()}")


class Slot:
    """The counters of one kind of traffic of one endpoint, as their process writes them. Times are ns.

    The counters live in attributes and go to the file in one piece, which costs a tenth of changing them there.
    """

    __slots__ = (
        "_acquire", "_age", "_age_greatest", "_age_least", "_age_squares", "_ages", "_answers", "_bank",
        "_bank_since", "_bank_until", "_count", "_first", "_latencies", "_latency", "_latency_greatest",
        "_latency_least", "_latency_squares", "_lock", "_lost", "_numbers", "_pending", "_period",
        "_period_greatest", "_period_least", "_period_squares", "_periods", "_processing", "_processing_greatest",
        "_processing_least", "_processing_squares", "_rare", "_release", "_shape", "_since", "_size", "_token",
        "_words", "last",
    )  # fmt: skip

    def __init__(self, words: memoryview) -> None:
        self._words = words
        self._numbers: memoryview[int] = words.cast("q")
        self._lock = threading.Lock()
        self._acquire, self._release = self._lock.acquire, self._lock.release
        self._token = self._numbers[SEQUENCE] + 1 & ~1
        self._reset()

    def _reset(self) -> None:
        self._count = self._first = self.last = self._bank = self._pending = self._since = 0
        self._periods = self._latencies = self._ages = self._answers = 0
        self._bank_since = self._bank_until = 0
        self._size = self._lost = -1
        self._period = self._period_squares = self._latency = self._latency_squares = 0.0
        self._age = self._age_squares = self._processing = self._processing_squares = 0.0
        self._shape, self._rare = _SHAPE.pack(-1, 0), _RARE.pack(-1, 0, 0, 0)
        self._no_extremes()

    def _no_extremes(self) -> None:
        self._period_least = self._latency_least = self._age_least = self._processing_least = float("inf")
        self._period_greatest = self._latency_greatest = float("-inf")
        self._age_greatest = self._processing_greatest = float("-inf")

    def begin(self, kind: int, gid: bytes, topic: str, node: str, other: str) -> None:
        """Fill the slot in for an endpoint, whatever was counted in it before."""
        numbers = self._numbers
        now = numbers[SEQUENCE] | 1
        generation = numbers[GENERATION]
        numbers[SEQUENCE] = now
        numbers[1:END] = array.array("q", bytes((END - 1) * 8))
        numbers[KIND] = kind
        numbers[GENERATION] = generation + 1
        numbers[BYTES] = numbers[LOST] = -1
        _EXTREMES.pack_into(self._words, BANKS_AT * 8, *_NOTHING_YET)
        numbers[GID : GID + 3] = array.array("q", gid[:24].ljust(24, b"\0"))
        for at, name in ((TOPIC, topic), (NODE, node), (OTHER, other)):
            text = name.encode("utf-8", "replace")[: NAME_BYTES - 1]
            numbers[at : at + NAME_BYTES // 8] = array.array("q", text.ljust(NAME_BYTES, b"\0"))
        self._reset()
        self._token = numbers[END] = numbers[SEQUENCE] = now + 1

    def leave(self) -> memoryview:
        """Give the words back; what its endpoint may still count goes to memory of its own, where nobody reads."""
        with self._lock:
            words = self._words
            self._words = memoryview(bytearray(SLOT_BYTES))
            self._numbers = self._words.cast("q")
            return words

    def arrived(
        self, now: int, when: int, latency: int | None, age: int | None, size: int, sequence: Sequence | None
    ) -> None:
        """Count a message that was taken.

        Args:
            now: when it is counted.
            when: of its receipt.
            latency: from its publishing to its receipt; None where unknown.
            age: from the stamp in its header to its receipt; None without one.
            size: serialised, in bytes; -1 where unknown.
            sequence: what knows the losses of the connection; None where nothing does.
        """
        # What is short is written out here and below: a call costs as much as all that it would do. So does ``with``.
        self._acquire()
        try:
            changed = not self._bank_since <= now < self._bank_until and self._next_bank(now)
            self._count += 1
            if size >= 0:
                self._size = size + max(0, self._size)
                self._shape = _SHAPE.pack(self._size, self._first)
            last = self.last
            self.last = when
            if not last:
                self._first = when
                self._shape = _SHAPE.pack(self._size, when)
            elif when >= last:  # otherwise the clock was set back, and nobody knows how long it really took
                value = (when - last) * 1e-9
                self._periods += 1
                self._period += value
                self._period_squares += value * value
                if value < self._period_least:
                    self._period_least = value
                    changed = True
                if value > self._period_greatest:
                    self._period_greatest = value
                    changed = True
            if latency is not None:
                value = latency * 1e-9
                self._latencies += 1
                self._latency += value
                self._latency_squares += value * value
                if value < self._latency_least:
                    self._latency_least = value
                    changed = True
                if value > self._latency_greatest:
                    self._latency_greatest = value
                    changed = True
            if sequence is not None and sequence.touched:
                sequence.touched = False
                self._lost, self._pending, self._since = sequence.lost, sequence.pending, sequence.pending_since
                self._rare = _RARE.pack(self._lost, self._pending, self._since, self._bank)
            numbers = self._numbers
            token = self._token
            numbers[SEQUENCE] = token + 1
            if age is None:
                _write_counters(
                    self._words, COUNT * 8, self._count, self._shape, when, self._rare, self._periods, self._period,
                    self._period_squares, self._latencies, self._latency, self._latency_squares,
                )  # fmt: skip
            else:
                changed |= self._aged(age * 1e-9)
                _write_aged(
                    self._words, COUNT * 8, self._count, self._shape, when, self._rare, self._periods, self._period,
                    self._period_squares, self._latencies, self._latency, self._latency_squares, self._ages,
                    self._age, self._age_squares,
                )  # fmt: skip
            if changed:
                self._write_extremes()
            self._token = numbers[END] = numbers[SEQUENCE] = token + 2
        finally:
            self._release()

    def published(self, now: int, size: int) -> None:
        """Count a message that was published at ``now``, of ``size`` bytes or -1."""
        self.arrived(now, now, None, None, size, None)

    def answered(self, now: int, processing: int) -> None:
        """Count a message published ``processing`` ns after the one that it answers was taken."""
        self._acquire()
        try:
            changed = not self._bank_since <= now < self._bank_until and self._next_bank(now)
            self._count += 1
            self.last = now
            value = processing * 1e-9
            self._answers += 1
            self._processing += value
            self._processing_squares += value * value
            if value < self._processing_least:
                self._processing_least = value
                changed = True
            if value > self._processing_greatest:
                self._processing_greatest = value
                changed = True
            numbers = self._numbers
            token = self._token
            numbers[SEQUENCE] = token + 1
            _write_answers(
                self._words, COUNT * 8, self._count, self._shape, now, self._rare, _NO_MOMENTS, self._answers,
                self._processing, self._processing_squares,
            )  # fmt: skip
            if changed:
                self._write_extremes()
            self._token = numbers[END] = numbers[SEQUENCE] = token + 2
        finally:
            self._release()

    def _write_extremes(self) -> None:
        _EXTREMES.pack_into(
            self._words, (BANKS_AT + self._bank % BANKS * BANK_WORDS) * 8, self._period_least, self._period_greatest,
            self._latency_least, self._latency_greatest, self._age_least, self._age_greatest,
            self._processing_least, self._processing_greatest,
        )  # fmt: skip

    def _aged(self, value: float) -> bool:
        self._ages += 1
        self._age += value
        self._age_squares += value * value
        changed = False
        if value < self._age_least:
            self._age_least = value
            changed = True
        if value > self._age_greatest:
            self._age_greatest = value
            changed = True
        return changed

    def _next_bank(self, now: int) -> bool:
        if self._bank_until:
            self._bank += 1
        self._bank_since = now >> BANK_SHIFT << BANK_SHIFT
        self._bank_until = self._bank_since + (1 << BANK_SHIFT)
        self._rare = _RARE.pack(self._lost, self._pending, self._since, self._bank)
        self._no_extremes()
        return True


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
        self._lock = threading.Lock()
        self._capacity = capacity

    def slot(self, kind: int, gid: bytes, topic: str, node: str, other: str = "", now: int = 0) -> Slot | None:
        """Return a slot for an endpoint; None where all are taken by endpoints of the last minute."""
        with self._lock:
            if len(self._slots) < self._capacity:
                at = HEADER_BYTES + len(self._slots) * SLOT_BYTES
                slot = Slot(self._view[at : at + SLOT_BYTES])
                slot.begin(kind, gid, topic, node, other)
                self._slots.append(slot)
                self._write("=I", USED_AT, len(self._slots))
                return slot
            oldest = min(self._slots, key=lambda slot: slot.last)
            if oldest.last + STALE_NS < now:
                self._slots.remove(oldest)
                slot = Slot(oldest.leave())
                slot.begin(kind, gid, topic, node, other)
                self._slots.append(slot)
                return slot
            self._write("=Q", OVERFLOW_AT, self._read("=Q", OVERFLOW_AT) + 1)
            return None

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
