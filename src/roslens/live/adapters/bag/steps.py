"""Times and sizes of messages, counted step by step as tallies."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from roslens.live.adapters.bag.block import NO_STAMP, Ints
from roslens.live.adapters.bag.moments_by_step import edges_of, greatest_by_step, moments_by_step
from roslens.model.tally import NOTHING, Observer, Tally

LONGEST_QUIET = 3600
LATEST = 1 << 62
"""Nanoseconds of the year 2116; what claims to be later is damaged."""

_NANO = 1e-9
_SECOND = 1_000_000_000


class Lane(NamedTuple):
    """A topic and, where it is known, the node that published."""

    topic: str
    publisher: str


class _Waiting:
    """Messages of a lane that were read and not counted yet, and the time of the last that was."""

    def __init__(self) -> None:
        self.pieces: list[tuple[Ints, Ints, Ints | None]] = []
        self.last: int | None = None


class Steps:
    """Counts messages, which come roughly in order, in steps of equal length.

    Args:
        start: nanoseconds at which the first step begins.
        length: of a step in nanoseconds.
        lanes: for each of which every step has a tally, also where nothing came.

    Attributes:
        late: messages whose step was over already when they came, or whose time is impossible; they are not counted.
        counted: messages that were.
        pending: messages that wait for their step to be over.
        jumps: pairs of nanoseconds between which nothing was recorded for so long that steps were left out.
    """

    def __init__(self, start: int, length: int, lanes: Iterable[Lane]) -> None:
        self.late = 0
        self.counted = 0
        self.pending = 0
        self.jumps: list[tuple[int, int]] = []
        self._start = start
        self._length = length
        self._waiting = {lane: _Waiting() for lane in sorted(lanes)}
        self._next = 0

    def add(self, lane: Lane, times: Ints, sizes: Ints, stamps: Ints | None) -> None:
        """Take messages; their order does not matter."""
        if len(times):
            self._waiting[lane].pieces.append((times, sizes, stamps))
            self.pending += len(times)

    def until(self, time: int) -> Iterator[tuple[float, list[Tally]]]:
        """Yield the steps that are over when nothing earlier than ``time`` will come, each with its end in seconds."""
        return self._through((min(time, LATEST) - self._start) // self._length)

    def rest(self, end: int) -> Iterator[tuple[float, list[Tally]]]:
        """Yield all other steps, at least up to the one that holds ``end``."""
        pieces = (piece for waiting in self._waiting.values() for piece in waiting.pieces)
        latest = max([end, *(int(times.max()) for times, _, _ in pieces)])
        return self._through((min(latest, LATEST) - self._start) // self._length + 1)

    def _through(self, bound: int) -> Iterator[tuple[float, list[Tally]]]:
        """Yield the steps before number ``bound``."""
        if bound <= self._next:
            return
        rows = {lane: self._cut(lane, waiting, bound) for lane, waiting in self._waiting.items()}
        filled = sorted(set().union(*rows.values()))
        for number in [*filled, bound]:
            quiet = number - self._next
            for empty in range(self._next, self._next + min(quiet, LONGEST_QUIET)):
                yield self._time(empty + 1) / _SECOND, [self._nothing(lane, empty) for lane in rows]
            if quiet > LONGEST_QUIET:
                self.jumps.append((self._time(self._next + LONGEST_QUIET), self._time(number)))
            if number < bound:
                tallies = [by_step.get(number) or self._nothing(lane, number) for lane, by_step in rows.items()]
                yield self._time(number + 1) / _SECOND, tallies
            self._next = number + 1
        self._next = bound

    def _time(self, number: int) -> int:
        return self._start + number * self._length

    def _nothing(self, lane: Lane, number: int) -> Tally:
        start, end = self._time(number) / _SECOND, self._time(number + 1) / _SECOND
        return Tally(lane.topic, lane.publisher, "", start, end, 0, 0, observer=Observer.RECORDING)

    def _cut(self, lane: Lane, waiting: _Waiting, bound: int) -> dict[int, Tally]:
        """Take the messages of a lane before step ``bound`` and count them by step."""
        if not waiting.pieces:
            return {}
        times, sizes, stamps = _joined(waiting.pieces)
        waiting.pieces.clear()
        edges = [self._time(self._next), min(self._time(bound), LATEST), LATEST]
        begin, stop, possible = np.searchsorted(times, edges).tolist()
        begin = min(begin, stop)
        self.late += begin + len(times) - possible
        self.counted += stop - begin
        self.pending -= len(times) - (possible - stop)
        if stop < possible:
            left = slice(stop, possible)
            # Copies, or a few messages would keep a whole batch in memory.
            pieces = times[left].copy(), sizes[left].copy(), None if stamps is None else stamps[left].copy()
            waiting.pieces.append(pieces)
        if begin == stop:
            return {}
        now = slice(begin, stop)
        previous, waiting.last = waiting.last, int(times[stop - 1])
        return self._tallies(lane, times[now], sizes[now], None if stamps is None else stamps[now], previous)

    def _tallies(self, lane: Lane, times: Ints, sizes: Ints, stamps: Ints | None, last: int | None) -> dict[int, Tally]:
        numbers = (times - self._start) // self._length
        edges = edges_of(numbers)
        ends = np.append(edges[1:], len(times)) - 1
        gaps = np.diff(times) if last is None else np.diff(times, prepend=last)
        of_gaps = numbers[len(times) - len(gaps) :]
        periods = moments_by_step(of_gaps, gaps * _NANO)
        begun = (times[len(times) - len(gaps) :] - gaps) / _SECOND
        longest = {step: float(begun[place]) for step, place in greatest_by_step(of_gaps, gaps).items()}
        ages = {}
        if stamps is not None:
            stamped = stamps != NO_STAMP
            ages = moments_by_step(numbers[stamped], (times[stamped] - stamps[stamped]) * _NANO)
        columns = (numbers[edges], ends - edges + 1, np.add.reduceat(sizes, edges), times[edges], times[ends])
        return {
            number: Tally(
                lane.topic,
                lane.publisher,
                "",
                self._time(number) / _SECOND,
                self._time(number + 1) / _SECOND,
                count,
                size,
                first / _SECOND,
                final / _SECOND,
                periods.get(number, NOTHING),
                age=ages.get(number, NOTHING),
                observer=Observer.RECORDING,
                longest_at=longest.get(number, 0.0),
            )
            for number, count, size, first, final in zip(*(column.tolist() for column in columns), strict=True)
        }


def _joined(pieces: list[tuple[Ints, Ints, Ints | None]]) -> tuple[Ints, Ints, Ints | None]:
    """Return the messages of all pieces by time."""
    times = np.concatenate([piece[0] for piece in pieces])
    sizes = np.concatenate([piece[1] for piece in pieces])
    stamps = None
    if any(piece[2] is not None for piece in pieces):
        unknown = [np.full(len(times), NO_STAMP, np.int64) if stamps is None else stamps for times, _, stamps in pieces]
        stamps = np.concatenate(unknown)
    if bool((times[1:] < times[:-1]).any()):
        order = np.argsort(times, kind="stable")
        times, sizes = times[order], sizes[order]
        stamps = stamps if stamps is None else stamps[order]
    return times, sizes, stamps
