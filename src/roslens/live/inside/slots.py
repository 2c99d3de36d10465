"""Counters of one process in a file in shared memory: one process writes without locks, anyone reads at any time.

All numbers have the byte order of the machine and lie on multiples of eight bytes, so that a program in any language
can write the file. A header of 4096 bytes is followed by slots of 3584 bytes, one for each kind of traffic of each
endpoint. ``used`` in the header grows after a slot has been filled in.

A slot begins and ends with the same even number while nobody writes it. A writer makes the first odd, writes, then
makes both the next even number; a reader that finds them different, or odd, reads again.

Counters only grow, so that any number of readers can take differences at their own pace and none needs to write. Least
and greatest cannot be had from a difference: they lie in a ring of 32 banks, of which the writer takes the next every
0.27 s in which there is traffic. A reader takes the extremes of the banks begun since its last read, and of the bank
that was current then those that changed: each extreme is reported once to each reader that reads at least every 8.5 s.

A later version may give slots more words, before their last one, and the header further values behind its own: who
knows this version reads such a file by what it knows, with the length of a slot that the header says. What changes the
meaning of a word has another magic.

The process holds an advisory lock (``flock``) on the file; the lock of a process that ended, however it ended, is free.
"""

from __future__ import annotations

import array
import os
import struct
import threading
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeAlias

    from .sequence import Sequence

    _Arrived: TypeAlias = Callable[[int, int, int | None, int | None, int, Sequence | None], None]
    _Answered: TypeAlias = Callable[[int, int], None]

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
MOST_SLOT_BYTES = 4 * SLOT_BYTES
"""Slots of later versions that are longer are not read: whoever reads for others copies them."""
CAPACITY = 1024

TAKEN, PUBLISHED, ANSWERED = 1, 2, 3
"""Kinds: taken from a publisher; published; published in answer to a message of the topic ``other``."""
REQUESTED, HEARD, ASKED, REPLIED = 4, 5, 6, 7
"""Kinds of a service, whose name is the topic: requests a client sent, responses it took, requests a server took,
responses it sent. The preloaded library alone counts them; processing is the time of a call, for client and server."""
KINDS = range(TAKEN, REPLIED + 1)

SEQUENCE, KIND, GENERATION, GID = 0, 1, 2, 3
COUNT, BYTES, FIRST, LAST, LOST, PENDING, PENDING_SINCE, BANK = 6, 7, 8, 9, 10, 11, 12, 13
PERIOD, LATENCY, AGE, PROCESSING = 14, 17, 20, 23
"""Each of the four is count, sum in seconds, sum of squares."""
ENDED = 26
"""When the endpoint was destroyed; 0 while it is there."""
BANKS_AT = 32
BANKS = 32
BANK_WORDS = 8
"""Least and greatest of period, latency, age and processing, in seconds."""
BANK_SHIFT = 28
_BANK_NS = 1 << BANK_SHIFT
TOPIC, NODE, OTHER = 288, 320, 352
NAME_BYTES = 256
END = WORDS - 1

STALE_NS = 60_000_000_000
REST_NS = 10_000_000_000
"""For so long what an endpoint counted last can be read after it ended: all readers read that often."""
_NEITHER = (float("inf"), float("-inf"))
_NOTHING_YET = _NEITHER * 4
_SHAPE = struct.Struct("@2q")
_RARE = struct.Struct("@4q")
"""What seldom changes goes into the piece as bytes that were packed before: each number costs as much as a write."""
_write_counters = struct.Struct("@q16sq32sqddqddqdd").pack_into
_write_answers = struct.Struct("@q16sq32s72sqdd").pack_into
_NO_SHAPE, _NO_MOMENTS = _SHAPE.pack(-1, 0), bytes(72)
_EXTREMES = struct.Struct("@8d")
_write_extremes = struct.Struct("@6d16s").pack_into
_write_processing = struct.Struct("@48s2d").pack_into
_NO_OTHERS, _NO_PROCESSING = _EXTREMES.pack(*_NOTHING_YET)[:48], _EXTREMES.pack(*_NOTHING_YET)[48:]


def folder_of(environment: Mapping[str, str], uid: int | None = None) -> str:
    """Return the folder of counter files that an environment names.

    Args:
        environment: variables by name.
        uid: number of the user; that of this process if None.
    """
    return environment.get(VARIABLE) or f"/dev/shm/roslens-{os.getuid() if uid is None else uid}"  # noqa: S108 - the folder is looked at before use


class _Seldom:
    """What few messages change, as the bytes in which it goes to the file."""

    __slots__ = ("_first", "_losses", "_size")

    def __init__(self) -> None:
        self._size, self._first = -1, 0
        self._losses = (-1, 0, 0)

    def shape(self, size: int, first: int) -> bytes:
        """Return the sizes and the time of the first message, with what one more tells; -1 and 0 where nothing."""
        if size >= 0:
            self._size = size + max(0, self._size)
        if first:
            self._first = first
        return _SHAPE.pack(self._size, self._first)

    def rare(self, bank: int, sequence: Sequence | None) -> bytes:
        """Return the losses and the number of the bank, with what a sequence tells, if any does."""
        if sequence is not None and sequence.touched:
            sequence.touched = False
            self._losses = sequence.lost, sequence.pending, sequence.pending_since
        return _RARE.pack(*self._losses, bank)


class Slot:
    """The counters of one kind of traffic of one endpoint, as their process writes them. Times are ns.

    The counters go to the file in one piece, which costs a tenth of changing them there. They live in the variables
    around the functions that count, which cost less than attributes, least of all on old Pythons.

    Attributes:
        arrived: counts a message that was taken or published. Its arguments are when it is counted, when it was
            received, how long that was after its publishing and how long after the stamp in its header (None where
            unknown), its size in bytes (-1 where unknown), and what knows the losses of the connection, or None.
        answered: counts a message that was published in answer to another, in a slot for these alone: when, and how
            long after the other one was taken.
        last: when the last message came.
        left: whether the words were given back.
    """

    __slots__ = ("_lock", "_numbers", "_words", "answered", "arrived", "last", "left")

    def __init__(self, words: memoryview) -> None:
        self._words = words
        self._numbers: memoryview[int] = words.cast("q")
        self._lock = threading.Lock()
        self.left = False
        self._count_anew()

    def _count_anew(self) -> None:
        self.last = 0
        self.arrived, self.answered = self._arrivals(), self._answers()

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
        numbers[END] = numbers[SEQUENCE] = now + 1
        self._count_anew()

    def end(self, now: int) -> None:
        """Note when the endpoint was destroyed: nothing more is counted here."""
        with self._lock:
            numbers = self._numbers
            token = numbers[SEQUENCE] | 1
            numbers[SEQUENCE] = token
            numbers[ENDED] = now
            numbers[END] = numbers[SEQUENCE] = token + 1

    def leave(self) -> memoryview:
        """Give the words back; what its endpoint may still count goes to memory of its own, where nobody reads."""
        with self._lock:
            self.left = True
            words = self._words
            self._words = memoryview(bytearray(SLOT_BYTES))
            self._numbers = self._words.cast("q")
            return words

    def published(self, now: int, size: int) -> None:
        """Count a message that was published at ``now``, of ``size`` bytes or -1."""
        self.arrived(now, now, None, None, size, None)

    # What each message needs is written out in what these return, as a call costs as much as all that it would do; so
    # does ``with``. What few messages need is a call.

    def _arrivals(self) -> _Arrived:  # noqa: C901 - of the functions in it, which share its variables
        acquire, release = self._lock.acquire, self._lock.release
        token = self._numbers[SEQUENCE] + 1 & ~1
        seldom = _Seldom()
        shape, rare = seldom.shape(-1, 0), b""
        bank, bank_at, bank_since, bank_until = -1, 0, 0, 0
        count = periods = latencies = ages = 0
        period = period_squares = latency_sum = latency_squares = age_sum = age_squares = 0.0
        period_least = latency_least = age_least = float("inf")
        period_greatest = latency_greatest = age_greatest = float("-inf")

        def next_bank(now: int) -> bool:
            nonlocal bank, bank_at, bank_since, bank_until, rare
            nonlocal period_least, latency_least, age_least, period_greatest, latency_greatest, age_greatest
            bank += 1
            bank_at = (BANKS_AT + bank % BANKS * BANK_WORDS) * 8
            bank_since = now >> BANK_SHIFT << BANK_SHIFT
            bank_until = bank_since + _BANK_NS
            rare = seldom.rare(bank, None)
            period_least = latency_least = age_least = _NEITHER[0]
            period_greatest = latency_greatest = age_greatest = _NEITHER[1]
            return True

        def renew(size: int, last: int, when: int, sequence: Sequence | None) -> None:
            nonlocal shape, rare
            shape, rare = seldom.shape(size, 0 if last else when), seldom.rare(bank, sequence)

        def widen_periods(value: float) -> bool:
            nonlocal period_least, period_greatest
            if value < period_least:
                period_least = value
            if value > period_greatest:
                period_greatest = value
            return True

        def widen_latencies(value: float) -> bool:
            nonlocal latency_least, latency_greatest
            if value < latency_least:
                latency_least = value
            if value > latency_greatest:
                latency_greatest = value
            return True

        def widen_ages(value: float) -> bool:
            nonlocal age_least, age_greatest
            if value < age_least:
                age_least = value
            if value > age_greatest:
                age_greatest = value
            return True

        def arrived(
            now: int, when: int, latency: int | None, age: int | None, size: int, sequence: Sequence | None
        ) -> None:
            nonlocal token, count, periods, latencies, ages
            nonlocal period, period_squares, latency_sum, latency_squares, age_sum, age_squares
            acquire()
            try:
                changed = not bank_since <= now < bank_until and next_bank(now)
                count += 1
                last = self.last
                self.last = when
                if 0 < last <= when:  # otherwise the clock was set back, and nobody knows how long it really took
                    value = (when - last) * 1e-9
                    periods += 1
                    period += value
                    period_squares += value * value
                    changed |= not period_least <= value <= period_greatest and widen_periods(value)
                if size >= 0 or not last or sequence is not None:
                    renew(size, last, when, sequence)
                if latency is not None:
                    value = latency * 1e-9
                    latencies += 1
                    latency_sum += value
                    latency_squares += value * value
                    changed |= not latency_least <= value <= latency_greatest and widen_latencies(value)
                if age is not None:
                    value = age * 1e-9
                    ages += 1
                    age_sum += value
                    age_squares += value * value
                    changed |= not age_least <= value <= age_greatest and widen_ages(value)
                numbers = self._numbers
                numbers[SEQUENCE] = token + 1
                _write_counters(
                    self._words, COUNT * 8, count, shape, when, rare, periods, period, period_squares,
                    latencies, latency_sum, latency_squares, ages, age_sum, age_squares,
                )  # fmt: skip
                if changed:
                    _write_extremes(
                        self._words, bank_at, period_least, period_greatest, latency_least, latency_greatest,
                        age_least, age_greatest, _NO_PROCESSING,
                    )  # fmt: skip
                token += 2
                numbers[END] = numbers[SEQUENCE] = token
            finally:
                release()

        return arrived

    def _answers(self) -> _Answered:
        acquire, release = self._lock.acquire, self._lock.release
        token = self._numbers[SEQUENCE] + 1 & ~1
        bank, bank_at, bank_since, bank_until, rare = -1, 0, 0, 0, b""
        count = 0
        total = squares = 0.0
        least, greatest = _NEITHER

        def next_bank(now: int) -> bool:
            nonlocal bank, bank_at, bank_since, bank_until, rare, least, greatest
            bank += 1
            bank_at = (BANKS_AT + bank % BANKS * BANK_WORDS) * 8
            bank_since = now >> BANK_SHIFT << BANK_SHIFT
            bank_until = bank_since + _BANK_NS
            rare = _RARE.pack(-1, 0, 0, bank)
            least, greatest = _NEITHER
            return True

        def answered(now: int, processing: int) -> None:
            nonlocal token, count, total, squares, least, greatest
            acquire()
            try:
                changed = not bank_since <= now < bank_until and next_bank(now)
                count += 1
                self.last = now
                value = processing * 1e-9
                total += value
                squares += value * value
                if value < least:
                    least = value
                    changed = True
                if value > greatest:
                    greatest = value
                    changed = True
                numbers = self._numbers
                numbers[SEQUENCE] = token + 1
                _write_answers(self._words, COUNT * 8, count, _NO_SHAPE, now, rare, _NO_MOMENTS, count, total, squares)
                if changed:
                    _write_processing(self._words, bank_at, _NO_OTHERS, least, greatest)
                token += 2
                numbers[END] = numbers[SEQUENCE] = token
            finally:
                release()

        return answered
