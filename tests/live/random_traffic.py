"""Traffic as unruly as that of real systems: jitter, gaps, silence, stepped clocks, late and repeated tallies."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

from roslens.model.traffic.tally import NOTHING, Moments, Observer, Tally


def of(values: list[float]) -> Moments:
    if not values:
        return NOTHING
    return Moments(len(values), sum(values), sum(one * one for one in values), min(values), max(values))


def messages(draw: Random, seconds: float, unruly: float) -> Iterator[tuple[float, int, float]]:
    """Yield times, sizes and latencies of messages at 20 Hz; each second one of them changes with a probability."""

    def one_of(usual: float, *others: float) -> float:
        return draw.choice(others) if draw.random() < unruly else usual

    at, hertz, size, latency, jitter, changes = draw.random() / 20, 20.0, 100, 0.01, 0.0, 0.0
    while at < seconds:
        if at >= changes:
            changes += draw.choice([0.6, 1.1, 2.3])
            hertz, jitter = one_of(20.0, 25.0, 16.0, 12.0, 40.0, 0.3), one_of(0.02, 0.2, 0.6)
            size, latency = int(one_of(100, 115, 130, 40)), one_of(0.01, 0.015, 0.025, 0.05)
        yield at, size, latency
        at += max(1 + jitter * (draw.random() - 0.5), 0.01) / hertz


def reported(draw: Random, publisher: str, observer: Observer, seconds: float) -> Iterator[tuple[float, Tally]]:
    """Yield what an observer tells of a connection, each with when it comes."""
    unruly = draw.choice([0.0, 0.1, 0.2, 0.6])
    stream, report = list(messages(draw, seconds, unruly)), draw.choice([0.1, 0.2, 0.2, 0.33])
    offset, delay = draw.choice([0.0, 0.0, -3.0, 500.0]), draw.choice([0.0, 0.02, 0.12])
    counts_only, silent, step_at = draw.random() < 0.15, draw.random() < 0.4, draw.choice([3.0, 5.0, 99.0, 99.0])
    start, last, place = 0.0, None, 0
    while start < seconds:
        end = start + report * (draw.choice([1.01, 1.6]) if draw.random() < unruly else 1.0)
        mine = []
        while place < len(stream) and stream[place][0] < end:
            mine.append(stream[place])
            place += 1
        shift = offset + (7.0 if start >= step_at else 0.0)
        times = [one[0] for one in mine]
        gaps = [
            b - a for a, b in zip([last, *times] if last is not None else times, times[last is None :], strict=False)
        ]
        last = times[-1] if times else last
        tally = Tally(
            "/a", publisher, "/s", start + shift, end + shift, len(mine), sum(one[1] for one in mine),
            times[0] + shift if times and not counts_only else 0.0,
            times[-1] + shift if times and not counts_only else 0.0,
            of([] if counts_only else gaps), of([one[2] for one in mine]),
            lost=int(draw.random() < 0.2 * unruly), observer=observer,
        )  # fmt: skip
        if not (silent and 2.2 < start < 3.1) and draw.random() > 0.03 * unruly:
            come = end + delay + (0.4 if draw.random() < 0.03 * unruly else 0.0)
            yield come, tally
            if draw.random() < 0.03 * unruly:
                yield come + 0.05, tally
        start = end
