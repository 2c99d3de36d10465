"""An alarm comes at most one window and 0.2 s after the fault began, on whichever way its news comes.

Messages of a scripted fault are reported as observers tell them: what a node counted in a stretch, so much later. Only
the time that the machine takes is left out.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import pytest

from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import Details, Expectation, Reference, Selector
from roslens.live.adapters.ros1.__main__ import GATHER_S
from roslens.live.adapters.ros2.__main__ import COUNT_EVERY_S as BESIDE_S
from roslens.live.agent.work import COUNT_EVERY_S
from roslens.live.inside.ros1_statistics import PERIOD_S
from roslens.live.inside.sequence import SETTLE_NS
from roslens.live.join.waiting import SHORTEST_S
from roslens.live.rate.monitor import Monitor
from roslens.model.entity import EntityKind
from roslens.model.traffic.tally import NOTHING, Moments, Observer, Tally
from roslens.model.verdict import State

WINDOW_S = 1.0
LATE_S = 0.2
LINE_S = 0.01
BEGIN_S = 8.0
PHASES = 16
SETTLE_S = SETTLE_NS * 1e-9


class Way(NamedTuple):
    """How news of a connection comes: counted every so many seconds, told so much later; ROS 1 tells no instants."""

    every: float
    after: float
    timed: bool


WAYS = {
    "agent": Way(COUNT_EVERY_S, LINE_S + SHORTEST_S, timed=True),
    "beside the monitor": Way(BESIDE_S, SHORTEST_S, timed=True),
    "statistics of ROS 1": Way(PERIOD_S, LINE_S + GATHER_S + SHORTEST_S, timed=False),
}


class Message(NamedTuple):
    at: float
    latency: float
    missing: bool = False


def messages(fault: Callable[[float], tuple[float, float, bool]], begin: float) -> list[Message]:
    """Return messages; ``fault`` says of a time after the begin: period, latency, and whether messages are missing."""
    found, at = [], 0.0
    while at < begin + 2:
        period, latency, missing = fault(at - begin) if at >= begin else (0.04, 0.001, False)
        found.append(Message(at, latency, missing))
        at += period
    return found


def moments(values: list[float]) -> Moments:
    return (
        Moments(len(values), sum(values), sum(v * v for v in values), min(values), max(values)) if values else NOTHING
    )


def tally(way: Way, sent: list[Message], start: float, end: float) -> Tally:
    """Return what was counted in a stretch: a loss when it has settled."""
    came = [one for one in sent if not one.missing]
    mine = [one for one in came if start <= one.at < end]
    before = [one.at for one in came if one.at < start][-1:]
    times = [*before, *(one.at for one in mine)]
    lost = [one for one in sent if one.missing]
    seen = [min((other.at for other in came if other.at > one.at), default=1e9) + SETTLE_S for one in lost]
    return Tally(
        "/scan", "/lidar", "/planner", start, end, len(mine),
        first=mine[0].at if mine and way.timed else 0.0,
        last=mine[-1].at if mine and way.timed else 0.0,
        period=moments([late - early for early, late in pairwise(times)]),
        latency=moments([one.latency for one in mine]),
        lost=sum(1 for at in seen if start <= at < end),
        observer=Observer.INSIDE,
    )  # fmt: skip


def alarm(way: Way, key: str, range_: str, sent: list[Message], begin: float) -> float:
    """Return seconds from the begin of the fault to the first alarm."""
    reported = (
        Expectation(Details("c.rate"), Selector(EntityKind.TOPIC, "/scan"), "rate", Range.parse("13..35")),
        Expectation(Details("c.it"), Selector(EntityKind.CONNECTION, "/scan"), key, Range.parse(range_)),
    )
    monitor = Monitor(Reference("test", expectations=reported), start=0.0)
    for number in range(1, round((begin + 2) / way.every)):
        start, end = (number - 1) * way.every, number * way.every
        now = end + way.after
        monitor.add_tally(tally(way, sent, start, end))
        bad = [one for one in monitor.tick(now) if one.state in (State.LOW, State.HIGH, State.ABSENT)]
        if bad:
            assert now >= begin, bad
            assert {one.quantity for one in bad} <= {key, "rate"}
            return now - begin
    pytest.fail("no alarm")


FAULTS = {
    "slower": ("rate", "15..35", lambda _: (0.1, 0.001, False)),
    "hardly too slow": ("rate", "15..35", lambda _: (1 / 14.5, 0.001, False)),
    "silent": ("rate", "15..35", lambda _: (100.0, 0.001, False)),
    "later": ("latency", "<= 0.015", lambda _: (0.04, 0.02, False)),
    "hardly too late": ("latency", "<= 0.015", lambda _: (0.04, 0.0155, False)),
    "one is lost": ("loss", "<= 1", lambda since: (0.04, 0.001, since < 0.04)),
    "some are lost": ("loss", "<= 20", lambda since: (0.04, 0.001, round(since / 0.04) % 4 == 0)),
}


# TCP loses nothing.
CASES = [(name, way) for name, (key, _, _) in FAULTS.items() for way in WAYS if key != "loss" or WAYS[way].timed]


@pytest.mark.parametrize(("name", "way"), CASES)
def test_an_alarm_is_in_time(name, way):
    key, range_, fault = FAULTS[name]
    late = []
    for step in range(PHASES):
        # It matters where the fault falls between two messages, and where between two tallies.
        begin = BEGIN_S + WAYS[way].every * step / PHASES
        late.append(alarm(WAYS[way], key, range_, messages(fault, begin), begin))
    assert max(late) <= WINDOW_S + LATE_S
