"""Reads the counter files of the nodes on this host; what two reads differ in becomes tallies."""

from __future__ import annotations

import fcntl
import mmap
import os
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import msgspec

from roslens.live.inside import slots
from roslens.live.inside.sequence import SETTLE_NS
from roslens.model.failure import Failure
from roslens.model.tally import NOTHING, Moments, Observer, Tally

_COUNTERS = struct.Struct("=14q" + "qdd" * 4)
_BANK = struct.Struct("=8d")
_TRIES = 100
_PAIRS = (0, 2, 4, 6)
_FIRST_TOKEN = slots.HEADER_BYTES // 8
_LOOK_S = 0.9
"""How long what changes rarely need not be looked at again."""
_BRISK_S = 60.0
"""What was silent for longer need not be told to be so at every read."""


class Snapshot(NamedTuple):
    """A slot as it was at one instant."""

    kind: int
    generation: int
    gid: bytes
    topic: str
    node: str
    other: str
    messages: int
    size: int
    first: int
    last: int
    lost: int
    pending: int
    pending_since: int
    bank: int
    moments: tuple[tuple[int, float, float], ...]
    banks: bytes


def snapshot(words: memoryview) -> Snapshot | None:
    """Copy a slot; None if it is being written whenever it is looked at.

    Two copies must agree, which also holds on processors that reorder what another one writes.
    """
    before = bytes(words)
    for _ in range(_TRIES):
        now = bytes(words)
        if now == before and not now[0] & 1 and now[:8] == now[-8:]:
            return _parsed(now)
        before = now
    return None


def _parsed(raw: bytes) -> Snapshot:
    values = _COUNTERS.unpack_from(raw)
    moments = values[14:]
    return Snapshot(
        kind=values[slots.KIND],
        generation=values[slots.GENERATION],
        gid=raw[slots.GID * 8 : slots.GID * 8 + 24],
        topic=_text(raw, slots.TOPIC * 8),
        node=_text(raw, slots.NODE * 8),
        other=_text(raw, slots.OTHER * 8),
        messages=values[slots.COUNT],
        size=values[slots.BYTES],
        first=values[slots.FIRST],
        last=values[slots.LAST],
        lost=values[slots.LOST],
        pending=values[slots.PENDING],
        pending_since=values[slots.PENDING_SINCE],
        bank=values[slots.BANK],
        moments=tuple(moments[at : at + 3] for at in (0, 3, 6, 9)),
        banks=raw[slots.BANKS_AT * 8 : (slots.BANKS_AT + slots.BANKS * slots.BANK_WORDS) * 8],
    )


def _text(raw: bytes, at: int, most: int = slots.NAME_BYTES) -> str:
    return raw[at : at + most].split(b"\0", 1)[0].decode("utf-8", "replace")


def _extremes(before: Snapshot | None, after: Snapshot) -> list[tuple[float, float]]:
    """Return least and greatest of each of the four series since ``before``, infinite where nothing shows them."""
    first = max(after.bank - slots.BANKS + 1, before.bank if before else 0)
    found = [float("inf"), float("-inf")] * 4
    for number in range(first, after.bank + 1):
        at = number % slots.BANKS * _BANK.size
        values = _BANK.unpack_from(after.banks, at)
        known = _BANK.unpack_from(before.banks, at) if before and number == before.bank else None
        for index, value in enumerate(values):
            if known is None or value != known[index]:
                found[index] = max(found[index], value) if index % 2 else min(found[index], value)
    return [(found[at], found[at + 1]) for at in _PAIRS]


def _moments(before: Snapshot | None, after: Snapshot) -> list[Moments]:
    moments = []
    for index, (least, greatest) in enumerate(_extremes(before, after)):
        known = before.moments[index] if before else (0, 0.0, 0.0)
        count, total, squares = (now - then for now, then in zip(after.moments[index], known, strict=True))
        if count <= 0:
            moments.append(NOTHING)
            continue
        mean = total / count
        # A series whose extremes lie within what had been told before still has some, on either side of its mean.
        low, high = (mean, mean) if count == 1 else (min(least, mean), max(greatest, mean))
        moments.append(Moments(int(count), total, max(squares, 0.0), low, high))
    return moments


def _lost(moment: Snapshot | None, now_ns: int) -> int:
    if moment is None or moment.lost < 0:
        return 0
    return moment.lost + (moment.pending if now_ns - moment.pending_since > SETTLE_NS else 0)


def difference(before: Snapshot | None, after: Snapshot, start: float, end: float, lost: int = 0) -> Tally:
    """Return what was counted between two reads of a slot, the names of nodes as they stand in it.

    Args:
        before: the earlier read; None where the slot is new.
        after: the later one.
        start: when the earlier was read, in seconds.
        end: when the later was.
        lost: messages already told as lost.
    """
    count = after.messages - (before.messages if before else 0)
    period, latency, age, processing = _moments(before, after)
    last = after.last * 1e-9
    if not count or after.kind == slots.ANSWERED:
        first = last = 0.0
    elif before is None or not before.messages:
        first = after.first * 1e-9
    elif count == 1:
        first = last
    else:
        # The first of several is not kept: it came about one period after the last before it.
        first = min(last, before.last * 1e-9 + (period.mean or 0.0))
    taken = after.kind == slots.TAKEN
    known = before.size if before and before.size > 0 else 0
    return Tally(
        after.topic,
        "" if taken else after.node,
        after.node if taken else "",
        start,
        end,
        count=count,
        bytes=-1 if after.size < 0 else after.size - known,
        first=first,
        last=last,
        period=period,
        latency=latency,
        age=age,
        lost=max(0, _lost(after, int(end * 1e9)) - lost) if after.lost >= 0 else -1,
        observer=Observer.INSIDE,
        processing=processing,
    )


class Counted(NamedTuple):
    """What was read of one slot: its process, the hexadecimal identifier of the publisher, and the tally.

    ``answers`` is the topic whose messages the tally's processing times begin with; empty for other slots.
    """

    pid: int
    gid: str
    tally: Tally
    answers: str


def _header(raw: mmap.mmap) -> tuple[Any, ...]:
    if len(raw) < slots.HEADER_BYTES:
        raise ValueError(f"{len(raw)} bytes, expected at least {slots.HEADER_BYTES}")
    header = slots.HEADER.unpack_from(raw)
    if header[:3] != (slots.MAGIC, slots.VERSION, slots.SLOT_BYTES):
        raise ValueError(f"magic {header[0]!r}, version {header[1]}, slots of {header[2]} bytes")
    return header


class _Known:
    """What was read of a slot last."""

    __slots__ = ("lost", "snapshot", "token", "until")

    def __init__(self) -> None:
        self.snapshot: Snapshot | None = None
        self.token = 1  # odd: somebody writes
        self.lost = 0
        self.until = 0.0


class _File:
    """One counter file, open for reading."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._handle = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
        try:
            size = os.fstat(self._handle).st_size
            self._map = mmap.mmap(self._handle, size, prot=mmap.PROT_READ)
            header = _header(self._map)
        except BaseException:
            os.close(self._handle)
            raise
        self._view = memoryview(self._map)
        self._most: int = min(header[3], (size - slots.HEADER_BYTES) // slots.SLOT_BYTES)
        self._tokens = self._view[: slots.HEADER_BYTES + self._most * slots.SLOT_BYTES].cast("q")
        self.pid: int = header[5]
        self.started: float = header[6] * 1e-9
        self.host = _text(header[9], 0)
        self.known: list[_Known] = []
        self.told = ""

    @property
    def ended(self) -> bool:
        """Whether the process that wrote the file is gone."""
        try:
            fcntl.flock(self._handle, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except OSError:
            return False
        fcntl.flock(self._handle, fcntl.LOCK_UN)
        return True

    def used(self) -> int:
        """Return how many slots are in use."""
        used: int = struct.unpack_from("=I", self._map, slots.USED_AT)[0]
        return min(used, self._most)

    def token(self, number: int) -> int:
        """Return the number that a slot has until somebody writes it."""
        token: int = self._tokens[_FIRST_TOKEN + number * slots.WORDS]
        return token

    def slot(self, number: int) -> Snapshot | None:
        """Copy a slot."""
        at = slots.HEADER_BYTES + number * slots.SLOT_BYTES
        return snapshot(self._view[at : at + slots.SLOT_BYTES])

    def trouble(self) -> str:
        """Return in words what keeps the hook from counting; empty if nothing does."""
        header = slots.HEADER.unpack_from(self._map)
        state = _text(header[10], 0)
        if "not counting" in state or "stopped" in state:
            return state
        return f"{header[8]} endpoints found no slot of {header[3]}" if header[8] else ""

    def close(self) -> None:
        """Let go of the file."""
        self._tokens.release()
        self._view.release()
        self._map.close()
        os.close(self._handle)


class Called(NamedTuple):
    """What was counted of a service: its process, which of the four kinds of a service, and how many and how long."""

    pid: int
    kind: int
    tally: Tally


class CounterReader:
    """Reads all counter files of a folder, again and again.

    What had been counted before the first read is not told: nobody knows when it happened. What has been silent for
    long is told once a second, however often is read.

    Args:
        folder: where the files are.
        tidy: whether to take the files of processes that ended away.
    """

    def __init__(self, folder: str, *, tidy: bool = True) -> None:
        self._folder = Path(folder)
        self._tidy = tidy
        self._files: dict[str, _File] = {}
        self._refused: set[str] = set()
        self._last: float | None = None
        self._looked = float("-inf")
        self._failures: list[Failure] = []
        self._called: list[Called] = []

    def read(self, now: float) -> list[Counted]:
        """Return what was counted since the last read; ``now`` is seconds since the epoch."""
        fresh = self._open_new()
        found: list[Counted] = []
        # Whether a process lives need not be known at once: what it counted is read first.
        thorough = not 0 <= now - self._looked < _LOOK_S
        for name, file in list(self._files.items()):
            ended = thorough and file.ended
            self._of(file, now, found, new=name in fresh)
            if thorough:
                self._watch(file)
            if ended:
                self._forget(name, file)
        if thorough:
            self._looked = now
        self._last = now
        return found

    def called(self) -> list[Called]:
        """Return what was counted of services since this was last asked."""
        called, self._called = self._called, []
        return called

    def nodes(self) -> dict[int, frozenset[str]]:
        """Return who counts in which process, by the id that the process sees itself."""
        return {
            file.pid: frozenset(one.snapshot.node for one in file.known if one.snapshot and one.snapshot.node)
            for file in self._files.values()
        }

    def failures(self) -> list[Failure]:
        """Return what went wrong since this was last asked."""
        failures, self._failures = self._failures, []
        return failures

    def close(self) -> None:
        """Let go of all files."""
        for file in self._files.values():
            file.close()
        self._files = {}

    def _open_new(self) -> set[str]:
        try:
            names = {entry.name for entry in self._folder.iterdir() if entry.name.endswith(slots.SUFFIX)}
        except OSError:
            return set()
        fresh = set()
        for name in sorted(names - self._files.keys() - self._refused):
            try:
                self._files[name] = _File(self._folder / name)
                fresh.add(name)
            except FileNotFoundError:
                continue
            except (OSError, ValueError, struct.error) as error:
                self._refused.add(name)
                self._failures.append(
                    Failure(
                        "inside",
                        f"{self._folder / name} cannot be read: {error}",
                        expected=f"a counter file of version {slots.VERSION}",
                        advice="Run nodes and monitor with the same version of roslens, or remove the file",
                    )
                )
        return fresh

    def _of(self, file: _File, now: float, found: list[Counted], *, new: bool) -> None:
        baseline = new and self._last is None
        begun = max(file.started, self._last or 0.0)
        for number in range(file.used()):
            if number == len(file.known):
                file.known.append(_Known())
            known = file.known[number]
            token = file.token(number)
            if token == known.token:
                before = known.snapshot
                if before is None or before.kind > slots.ANSWERED:
                    continue
                if known.lost >= before.lost + before.pending or before.lost < 0:
                    if now - known.until >= _LOOK_S or now - before.last * 1e-9 < _BRISK_S:
                        found.append(_still(file.pid, before, min(known.until, now), now))
                        known.until = now
                    continue
            after = file.slot(number)
            if after is None:
                continue
            before = known.snapshot
            start = known.until
            if before is None or before.generation != after.generation:
                before, start, known.lost = None, begun, 0
            told, known.lost = known.lost, max(known.lost, _lost(after, int(now * 1e9)))
            known.snapshot, known.until, known.token = after, now, token
            if baseline:
                continue
            tally = difference(before, after, min(start, now), now, told)
            if after.kind > slots.ANSWERED:
                self._called.append(Called(file.pid, after.kind, tally))
            else:
                found.append(Counted(file.pid, _gid(after), tally, after.other))

    def _watch(self, file: _File) -> None:
        trouble = file.trouble()
        if trouble and trouble != file.told:
            file.told = trouble
            self._failures.append(
                Failure(
                    "inside",
                    f"process {file.pid} on {file.host}: {trouble}",
                    expected="a hook that counts all traffic of the process",
                    advice="Watch its topics with --tap instead",
                )
            )

    def _forget(self, name: str, file: _File) -> None:
        del self._files[name]
        file.close()
        if not self._tidy:
            self._refused.add(name)
            return
        try:
            file.path.unlink()
        except OSError:
            # Somebody else's, or gone already: in neither case to be looked at again.
            self._refused.add(name)


def _gid(of: Snapshot) -> str:
    return of.gid[:16].hex() if of.kind == slots.TAKEN else ""


def _still(pid: int, of: Snapshot, start: float, end: float) -> Counted:
    """Return that nothing was counted in a slot."""
    taken = of.kind == slots.TAKEN
    tally = Tally(
        of.topic, "" if taken else of.node, of.node if taken else "", start, end, 0, min(of.size, 0),
        lost=min(of.lost, 0), observer=Observer.INSIDE,
    )  # fmt: skip
    return Counted(pid, _gid(of), tally, of.other)


def joined(counted: list[Counted], node_of: Callable[[str], str | None], host: str) -> list[Tally]:
    """Return one tally per connection, publishers by name and processing times with what was published.

    Args:
        counted: what one read yielded.
        node_of: the node of a publisher by its hexadecimal identifier; None for one that is not there any more.
        host: on which all this was counted.
    """
    whole: dict[tuple[str, str, str], Tally] = {}
    for one in counted:
        tally = one.tally
        publisher = tally.publisher
        if one.gid:
            name = node_of(one.gid)
            if name is None and not tally.count and tally.lost <= 0:
                continue
            publisher = name or ""
        if one.answers:
            tally = msgspec.structs.replace(tally, count=0, lost=-1, bytes=-1)
        tally = msgspec.structs.replace(tally, publisher=publisher, host=host)
        key = (tally.topic, tally.publisher, tally.subscriber)
        whole[key] = _merged(whole[key], tally) if key in whole else tally
    return [whole[key] for key in sorted(whole)]


def _merged(one: Tally, other: Tally) -> Tally:
    firsts = [tally.first for tally in (one, other) if tally.first]
    return msgspec.structs.replace(
        one,
        start=min(one.start, other.start),
        count=one.count + other.count,
        bytes=_added(one.bytes, other.bytes),
        first=min(firsts, default=0.0),
        last=max(one.last, other.last),
        period=one.period.merged(other.period),
        longest_at=(other if other.period.greatest > one.period.greatest else one).longest_at,
        latency=one.latency.merged(other.latency),
        age=one.age.merged(other.age),
        lost=_added(one.lost, other.lost),
        processing=one.processing.merged(other.processing),
    )


def _added(one: int, other: int) -> int:
    return max(one, other) if one < 0 or other < 0 else one + other
