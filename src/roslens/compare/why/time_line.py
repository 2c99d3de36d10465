"""When the messages of a topic came, and where their time line breaks: silence, a gap, or a lower rate."""

from __future__ import annotations

from enum import Enum

import msgspec
import numpy as np
import numpy.typing as npt

Seconds = npt.NDArray[np.float64]

LEAST_SILENCE_S = 1.0
"""What is shorter is no silence, however fast a topic is."""
TIMES_USUAL = 5.0
"""A silence is at least so many times what 95 % of the distances between two messages are below."""
_FEWEST = 10
_WINDOWS = 20
_LATE_WINDOWS = 3
_FEWEST_IN_WINDOW = 10
_STEADY = 0.7
_SLOW = 0.6


class BreakKind(str, Enum):
    """How a time line breaks."""

    STOP = "stop"
    GAP = "gap"
    SLOW = "slow"


class Break(msgspec.Struct, frozen=True):
    """A break: seconds of the last good message and of the next one (of a stop the end of the recording)."""

    kind: BreakKind
    since: float
    until: float


class TimeLine(msgspec.Struct, frozen=True):
    """What the times of the messages of a topic come to; all times in seconds.

    Attributes:
        count: messages.
        first: time of the first one; 0 without any.
        last: time of the last one; 0 without any.
        usual: median of the distances between two; 0 where there are too few to tell.
        rate: messages per second between the first and the last; 0 where there are too few to tell.
        breaks: what is wrong with it, the gravest first.
    """

    count: int
    first: float = 0.0
    last: float = 0.0
    usual: float = 0.0
    rate: float = 0.0
    breaks: tuple[Break, ...] = ()


def time_line(times: Seconds, end: float) -> TimeLine:
    """Return what sorted times of messages come to, observed until ``end``.

    A topic of fewer than ten messages has no rate, so that its silence says nothing. A lower rate is told of a topic
    that was steady in the first third of its time, and stayed below 0.6 of that rate for at least the last 3 of 20
    windows, where at least ten messages are usual in each: fewer vary by chance.
    """
    count = len(times)
    if not count:
        return TimeLine(0)
    first, last = float(times[0]), float(times[-1])
    if count < _FEWEST or last <= first:
        return TimeLine(count, first, last)
    gaps = np.diff(times)
    usual = float(np.median(gaps))
    silence = max(LEAST_SILENCE_S, TIMES_USUAL * float(np.percentile(gaps, 95)))
    breaks = []
    if end - last > silence:
        breaks.append(Break(BreakKind.STOP, last, end))
    elif (slow := _slower(times, gaps)) is not None:
        breaks.append(Break(BreakKind.SLOW, slow, last))
    longest = int(np.argmax(gaps))
    if gaps[longest] > silence:
        breaks.append(Break(BreakKind.GAP, float(times[longest]), float(times[longest + 1])))
    return TimeLine(count, first, last, usual, (count - 1) / (last - first), tuple(breaks))


def _slower(times: Seconds, gaps: Seconds) -> float | None:
    """Return since when fewer messages come than at first; None where that is not so, or they never came steadily."""
    edges = np.linspace(times[0], times[-1], _WINDOWS + 1)
    counts = np.diff(np.searchsorted(times, edges)).astype(float)
    early = counts[: _WINDOWS // 3]
    steady = float(np.median(early))
    late_counts = counts[-_LATE_WINDOWS:]
    if steady < _FEWEST_IN_WINDOW or early.min() < _STEADY * steady or late_counts.max() >= _SLOW * steady:
        return None
    good = np.flatnonzero(counts >= _SLOW * steady)
    begin = np.searchsorted(times, edges[good[-1]])
    distance = (edges[1] - edges[0]) / steady
    late = np.flatnonzero(gaps[begin:] > distance / _SLOW)
    return float(times[begin + late[0]]) if len(late) else None
