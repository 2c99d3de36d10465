"""What rating costs: packed frames in, verdicts out, on one core.

Usage: live_rating.py [seconds of the steady run]. Prints the share of a core at 10,000 tallies a second over 2,000
connections with 1,000 wildcard expectations, and how many tallies a second a core can take at most. Both are of steady
traffic with every value inside its range, decoding included; no two tallies say the same. The peak of memory holds the
packed frames of both runs, so their size is reported too.
"""

from __future__ import annotations

import resource
import sys
import time
from random import Random

from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import Details, Expectation, Reference, Selector, Timing
from roslens.live.rate.monitor import Monitor
from roslens.model.entity import EntityKind
from roslens.model.traffic.tally import Moments, Observer, Tally
from roslens.model.wire import VERSION, Frame, decode_frame, encode_frame

CONNECTIONS = 2000
PER_TOPIC = 4
GROUPS = 50
REPORTS = 5
"""Tallies of a connection a second."""
TICKS = 10
RATE = 40.0
WARM_S = 3.0
"""What comes before is not measured: grace, and the first verdict of each sentence."""
PREFIX = 4


def topic_of(number: int) -> str:
    """Return the topic of a connection."""
    topic = number // PER_TOPIC
    return f"/robot{topic % GROUPS}/part{topic}/signal"


def reference() -> Reference:
    """Return 1,000 expectations with wildcards, so that each topic and connection has about ten."""
    sentences = []
    for number in range(1000):
        group, kind = number % GROUPS, number // GROUPS
        quantity, range_ = (
            ("rate", Range(25, 60)),
            ("largest_gap", Range(None, 0.5)),
            ("latency", Range(None, 0.1)),
            ("bandwidth", Range(None, 1e6)),
            ("jitter", Range(None, 0.1)),
        )[kind % 5]
        entity = EntityKind.TOPIC if kind < 10 else EntityKind.CONNECTION
        name = f"/robot{group}/*/signal" if kind % 2 else f"/robot{group}/**"
        details = Details(f"bench.{number}", timing=Timing(grace=1.0))
        sentences.append(Expectation(details, Selector(entity, name), quantity, range_))
    return Reference("bench", expectations=tuple(sentences))


def frame_at(start: float, end: float, sequence: int, numbers: range) -> bytes:
    """Return what an observer packs of these connections in a stretch of time."""
    tallies = []
    draw = Random(sequence).random
    for number in numbers:
        count = max(round((end - start) * RATE), 1)
        step = (end - start) / count
        late = (draw() - 0.5) * 0.1 * step
        last = end - step / 2 + late
        mean = step * (0.99 + 0.02 * draw())
        period = Moments(count, count * mean, count * mean * mean * 1.001, 0.9 * mean, 1.1 * mean)
        delay = 0.001 * (1 + draw())
        latency = Moments(count, count * delay, count * delay * delay * 1.01, 0.9 * delay, 1.2 * delay)
        size = count * 200 + round(9 * draw())
        tallies.append(
            Tally(
                topic_of(number), f"/node{number // PER_TOPIC}", f"/sub{number}", start, end, count, size,
                start + step / 2 + late, last, period, latency, observer=Observer.INSIDE, host="robot",
            )
        )  # fmt: skip
    return encode_frame(Frame(VERSION, "robot/inside", sequence, end, tallies))[PREFIX:]


def frames_of(seconds: float, per_second: float) -> list[tuple[float, bytes]]:
    """Return the frames of a run, ten a second, each with a tenth of the tallies of that second."""
    every = CONNECTIONS / per_second
    share = round(per_second / TICKS)
    frames, place = [], 0
    for step in range(round(seconds * TICKS)):
        now = (step + 1) / TICKS
        rounds = max(share // CONNECTIONS, 1)
        numbers = [(place + one) % CONNECTIONS for one in range(min(share, CONNECTIONS))]
        place += share
        for first in range(0, len(numbers), 200):
            chunk = numbers[first : first + 200]
            if chunk[-1] < chunk[0]:
                continue
            for turn in range(rounds):
                end = now - (rounds - 1 - turn) * every
                frames.append((now, frame_at(end - every, end, step, range(chunk[0], chunk[-1] + 1))))
    return frames


def run(frames: list[tuple[float, bytes]], monitor: Monitor) -> tuple[float, int, int]:
    """Feed frames and tick; return CPU seconds, tallies and changes of verdicts."""
    tallies = changes = 0
    begun = time.process_time()
    shown = frames[0][0]
    for now, body in frames:
        if now != shown:
            changes += len(monitor.tick(shown))
            shown = now
        frame = decode_frame(body)
        tallies += len(frame.tallies)
        monitor.add_frame(frame)
    changes += len(monitor.tick(shown))
    return time.process_time() - begun, tallies, changes


def turn_ns() -> float:
    """Return what a turn of an empty loop costs at this moment: a busy machine shows here first."""
    begun = time.process_time()
    for _ in range(1_000_000):
        pass
    return (time.process_time() - begun) * 1000


def main() -> None:
    """Measure both and print them."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0
    monitor = Monitor(reference(), start=0.0)
    frames = frames_of(seconds + WARM_S, CONNECTIONS * REPORTS)
    begin = [frame for frame in frames if frame[0] <= WARM_S]
    run(begin, monitor)
    spent, tallies, changes = run(frames[len(begin) :], monitor)
    judged = monitor.standing()
    print(f"a turn of an empty loop takes {turn_ns():.0f} ns on this machine now")
    print(f"connections {CONNECTIONS}, verdicts {len(judged)}, not ok {sum(v.state.value != 'ok' for v in judged)}")
    print(f"steady: {tallies / seconds:,.0f} tallies/s, {TICKS} ticks/s: {100 * spent / seconds:.1f} % of a core")
    print(f"        {spent / tallies * 1e6:.1f} us a tally, {changes} changes")
    flood = frames_of(seconds / 2 + WARM_S, 100_000)
    monitor = Monitor(reference(), start=0.0)
    begin = [frame for frame in flood if frame[0] <= WARM_S]
    run(begin, monitor)
    spent, tallies, changes = run(flood[len(begin) :], monitor)
    bad = sum(verdict.state.bad for verdict in monitor.standing())
    print(f"flood:  {tallies / spent:,.0f} tallies/s at most, {spent / tallies * 1e6:.1f} us a tally, {bad} bad")
    packed = sum(len(body) for _, body in (*frames, *flood)) / 2**20
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak memory {peak:.0f} MB, of it {packed:.0f} MB packed frames")


if __name__ == "__main__":
    main()
