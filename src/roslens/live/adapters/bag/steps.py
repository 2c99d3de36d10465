"""Times and sizes of messages, counted step by step as tallies."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from roslens.live.adapters.bag.block import NO_STAMP, Ints
from roslens.live.adapters.bag.moments_by_step import edges_of, greatest_of, moments_of
from roslens.model.traffic.tally import NOTHING, Observer, Tally

LONGEST_QUIET = 3600
LATEST = 1 << 62
"""Nanoseconds of the year 2116; what claims to be later is damaged."""

_MANY = 16
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
        times, sizes, stamps = joined(waiting.pieces)
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
        numbers, edges = self._parted(times)
        ends = np.append(edges[1:], len(times)) - 1
        of_gaps, gap_edges = numbers, edges
        gaps = np.empty_like(times)
        np.subtract(times[1:], times[:-1], out=gaps[1:])
        gaps[0] = 0 if last is None else int(times[0]) - last
        if last is None:  # the first of all has nothing before it
            gaps = gaps[1:]
            gap_edges = np.maximum(edges - 1, 0)
            if not ends[0]:
                of_gaps, gap_edges = numbers[1:], gap_edges[1:]
        periods = moments_of(of_gaps, gap_edges, gaps)
        begun = times[len(times) - len(gaps) :]
        places = greatest_of(gap_edges, gaps)
        longest = dict(zip(of_gaps.tolist(), ((begun[places] - gaps[places]) / _SECOND).tolist(), strict=True))
        ages = {}
        if stamps is not None:
            stamped = np.flatnonzero(stamps != NO_STAMP)
            stamped_numbers, stamped_edges = self._parted(times[stamped])
            ages = moments_of(stamped_numbers, stamped_edges, times[stamped] - stamps[stamped])
        columns = (numbers, ends - edges + 1, np.add.reduceat(sizes, edges), times[edges], times[ends])
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

    def _parted(self, times: Ints) -> tuple[Ints, Ints]:
        """Return the numbers of the steps in which the times lie, which do not fall, and where each begins."""
        if not len(times):
            return times, times
        first, last = (int(times[place] - self._start) // self._length for place in (0, -1))
        if (last - first) * _MANY > len(times):
            numbers = (times - self._start) // self._length
            edges = edges_of(numbers)
            return numbers[edges], edges
        # Far fewer steps than times: looking each up is faster than dividing all.
        numbers = np.arange(first, last + 1)
        edges = np.searchsorted(times, numbers * self._length + self._start)
        filled = np.diff(edges, append=len(times)) > 0
        return numbers[filled], edges[filled]


def joined(pieces: list[tuple[Ints, Ints, Ints | None]]) -> tuple[Ints, Ints, Ints | None]:
    """Return the messages of all pieces by time."""
    if not pieces:
        return np.zeros(0, np.int64), np.zeros(0, np.int64), None
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
