"""Reads the counter files of the nodes on this host; what two reads differ in becomes tallies."""

from __future__ import annotations

import struct
from collections.abc import Callable, Container
from pathlib import Path
from typing import NamedTuple

import msgspec

from roslens.live.inside import slots
from roslens.live.inside.opened_file import CutOffError, OpenedFile, open_file
from roslens.live.inside.snapshot import Snapshot, difference, lost_by
from roslens.model.failure import Failure
from roslens.model.traffic.tally import NOTHING, Observer, Tally

_LOOK_S = 0.9
"""How long what changes rarely need not be looked at again."""
_BRISK_S = 60.0
"""What was silent for longer need not be reported at every read."""
_UNUSUAL = 1.2
"""Nor need what was silent for less than so many usual times between messages."""


class Counted(NamedTuple):
    """What was read of one slot: its process, the hexadecimal identifier of the publisher, and the tally.

    ``answers`` is the topic whose messages the tally's processing times begin with; empty for other slots.
    """

    pid: int
    gid: str
    tally: Tally
    answers: str


class _Known:
    """What was read of a slot last."""

    __slots__ = ("due", "lost", "snapshot", "token", "until")

    def __init__(self) -> None:
        self.snapshot: Snapshot | None = None
        self.token = 1  # odd: somebody writes
        self.lost = 0
        self.until = 0.0
        self.due: float | None = 0.0

    def reported(self, now: float) -> None:
        """Note that it was reported up to ``now``; when it has to be next is only asked if nobody writes it."""
        self.until = now
        self.due = None

    def is_due(self, now: float) -> bool:
        """Whether it has to be reported again that nothing came, or the clock was set back.

        That is reported at every read once it is longer than is usual, and else, or after long, at times.
        """
        if self.due is None:
            self.due = self.until + _LOOK_S
            of = self.snapshot
            if of is not None and self.until - of.last * 1e-9 < _BRISK_S:
                count, total = of.moments[:2]
                self.due = min(self.due, of.last * 1e-9 + _UNUSUAL * total / count if count else self.until)
        return now >= self.due or now < self.until


class Called(NamedTuple):
    """What was counted of a service: its process, which of the four kinds of a service, and how many and how long."""

    pid: int
    kind: int
    tally: Tally


class CounterReader:
    """Reads all counter files of a folder, again and again.

    What had been counted before the first read is not reported: nobody knows when it happened. What has been silent for
    long is reported once a second, however often is read.

    Args:
        folder: where the files are.
        tidy: whether to take the files of processes that ended away.
    """

    def __init__(self, folder: str, *, tidy: bool = True) -> None:
        self._folder = Path(folder)
        self._tidy = tidy
        self._files: dict[str, OpenedFile] = {}
        self._refused: set[str] = set()
        self._last: float | None = None
        self._looked = float("-inf")
        self._failures: list[Failure] = []
        self._called: list[Called] = []

    def read(self, now: float) -> list[Counted]:
        """Return what was counted since the last read; ``now`` is seconds since the epoch."""
        found: list[Counted] = []
        # Only agents request calls: unrequested ones must not pile up.
        self._called = []
        self._visit(now, lambda file, new: self._of(file, now, found, new=new))
        self._last = now
        return found

    def look(self, now: float) -> None:
        """Find out who counts, as :meth:`nodes` tells it, without reading what was counted."""
        self._visit(now, lambda file, _: _name(file))

    def _visit(self, now: float, each: Callable[[OpenedFile, bool], None]) -> None:
        """Do something with each file, and whether it is new; let go of those of processes that ended."""
        fresh = self._open_new()
        # Whether a process lives need not be known at once: what it counted is read first.
        thorough = not 0 <= now - self._looked < _LOOK_S
        for name, file in list(self._files.items()):
            ended = thorough and file.ended
            try:
                each(file, name in fresh)
                if thorough:
                    self._watch(file)
            except CutOffError as error:
                self._refuse(name, error)
                del self._files[name]
                file.close()
                continue
            if ended:
                self._forget(name, file)
        if thorough:
            self._looked = now

    def called(self) -> list[Called]:
        """Return what the last read found counted of services."""
        return self._called

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
        self._refused &= names
        fresh = set()
        for name in sorted(names - self._files.keys() - self._refused):
            try:
                self._files[name] = open_file(self._folder / name)
                fresh.add(name)
            except FileNotFoundError:
                continue
            except (OSError, ValueError, struct.error) as error:
                self._refuse(name, error)
        return fresh

    def _refuse(self, name: str, error: Exception) -> None:
        self._refused.add(name)
        self._failures.append(
            Failure(
                "inside",
                f"{self._folder / name} cannot be read: {error}",
                expected=f"a counter file of version {slots.VERSION} or later",
                advice="Run nodes and monitor with the same version of roslens, or remove the file",
            )
        )

    def _of(self, file: OpenedFile, now: float, found: list[Counted], *, new: bool) -> None:
        tokens = file.tokens()
        while len(file.known) < len(tokens):
            file.known.append(_Known())
        for number, token in enumerate(tokens):
            known = file.known[number]
            if token != known.token:
                self._anew(file, number, token, now, None if new and self._last is None else found)
            elif known.is_due(now):
                self._unchanged(file.pid, known, now, found)

    def _anew(self, file: OpenedFile, number: int, token: int, now: float, found: list[Counted] | None) -> None:
        """Read a slot that was written to; ``found`` is None where what it holds was counted before anybody looked."""
        known = file.known[number]
        before = known.snapshot
        after = file.slot(number, before)
        if after is None:
            return
        known.token = token
        if after.kind not in slots.KINDS:
            self._tell_unknown(file, after.kind)
            return
        if before is None or before.generation != after.generation:
            before, known.until, known.lost = None, max(file.started, self._last or 0.0), 0
        self._changed(file.pid, known, before, after, now, found)

    def _unchanged(self, pid: int, known: _Known, now: float, found: list[Counted]) -> None:
        """Report that nothing was counted; messages that were missing then may count as lost by now."""
        of = known.snapshot
        if of is None or of.kind > slots.ANSWERED:
            known.due = float("inf")
        elif of.lost >= 0 and known.lost < of.lost + of.pending:
            self._changed(pid, known, of, of, now, found)
        elif of.ended:
            known.due = float("inf")
        else:
            found.append(_still(pid, of, min(known.until, now), now))
            known.reported(now)

    def _changed(
        self, pid: int, known: _Known, before: Snapshot | None, after: Snapshot, now: float, found: list[Counted] | None
    ) -> None:
        """Report what was counted; what was counted at an unknown time is not reported (None)."""
        start, reported = min(known.until, now), known.lost
        known.lost = max(reported, lost_by(after, int(now * 1e9)))
        known.snapshot = after
        known.reported(now)
        if found is None:
            return
        tally = difference(before, after, start, now, reported)
        if after.kind > slots.ANSWERED:
            self._called.append(Called(pid, after.kind, tally))
        else:
            found.append(Counted(pid, _gid(after), tally, after.other))

    def _tell_unknown(self, file: OpenedFile, kind: int) -> None:
        if file.strange:
            return
        file.strange = True
        self._failures.append(
            Failure(
                "inside",
                f"process {file.pid} on {file.host} counts traffic of kind {kind}, which is left out",
                expected=f"kinds {slots.KINDS[0]} to {slots.KINDS[-1]}",
                advice="Run nodes and monitor with the same version of roslens",
            )
        )

    def _watch(self, file: OpenedFile) -> None:
        trouble = file.trouble()
        if trouble and trouble != file.reported:
            file.reported = trouble
            self._failures.append(
                Failure(
                    "inside",
                    f"process {file.pid} on {file.host}: {trouble}",
                    expected="a hook that counts all traffic of the process",
                    advice="Watch its topics with --tap instead",
                )
            )

    def _forget(self, name: str, file: OpenedFile) -> None:
        del self._files[name]
        file.close()
        if not self._tidy:
            self._refused.add(name)
            return
        try:
            file.path.unlink()
        except OSError:
            # Of another user, or gone already: not to be read again in either case.
            self._refused.add(name)


def _name(file: OpenedFile) -> None:
    """Find out whose the slots of a file are: names change with the generation of a slot alone."""
    known = file.known
    for number, generation in enumerate(file.generations()):
        if number == len(known):
            known.append(_Known())
        before = known[number].snapshot
        if before is None or before.generation != generation:
            known[number].snapshot = file.slot(number, None) or before


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


def joined(
    counted: list[Counted], node_of: Callable[[str], str | None], host: str, several: Container[tuple[str, str]] = ()
) -> list[Tally]:
    """Return one tally per connection, publishers by name and processing times with what was published.

    Args:
        counted: what one read yielded.
        node_of: the node of a publisher by its hexadecimal identifier; None for one that is not there any more.
        host: on which all this was counted.
        several: node and topic of publishers that are there more than once under one name.
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
            tally = msgspec.structs.replace(tally, publisher=publisher, host=host, count=0, lost=-1, bytes=-1)
        else:
            tally = msgspec.structs.replace(tally, publisher=publisher, host=host)
        key = (tally.topic, tally.publisher, tally.subscriber)
        if (tally.publisher, tally.topic) in several:
            tally = superposed(tally)
        whole[key] = merged(whole[key], tally) if key in whole else tally
    return [whole[key] for key in sorted(whole)]


def superposed(tally: Tally) -> Tally:
    """Return a tally to be merged with those of other publishers of the same name: their messages add up.

    The times between the messages of each of them are none between those of all, which the counts tell.
    """
    return msgspec.structs.replace(tally, period=NOTHING, longest_at=0.0) if tally.period.count else tally


def merged(one: Tally, other: Tally) -> Tally:
    """Return the union of two tallies of the same time."""
    firsts = [tally.first for tally in (one, other) if tally.first]
    return msgspec.structs.replace(
        one,
        start=min(one.start, other.start),
        end=max(one.end, other.end),
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
