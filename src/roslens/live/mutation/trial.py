"""Trials: a fault, its place, and the verdicts of a reference that it causes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

import msgspec

from roslens.judge.reference.expectation import Reference
from roslens.judge.reference.merge_references import constraints_of
from roslens.live.mutation.fault import DELAY_S, Fault, FaultKind, graphs
from roslens.live.replay.alarms import Alarm, AlarmLog
from roslens.live.replay.replay import Recording, replay
from roslens.live.system.connection_name import connection_ends
from roslens.model.entity import EntityKind
from roslens.model.graph import Graph

BEFORE_S = 10.0
"""So much of a recording is replayed before a fault, besides the longest grace and window of the reference."""
AFTER_S = 10.0
LENGTH_S = 5.0
"""How long a fault lasts, of a topic that is not slow."""
LEAST_PERIODS = 5
"""Of a slow topic it lasts for so many of its periods, as far as the recording has room."""
EARLY_S = 1.0
"""An alarm may begin so long before the fault, because gaps begin with the message before."""


class Trial(msgspec.Struct, frozen=True):
    """What came of a fault.

    Attributes:
        fault: that was put in.
        seen: whether an alarm about it was raised that is not there without it.
        after_s: seconds from its begin to when the first one was reported; None where there is none.
        by: ids of the constraints that saw it, sorted.
        beside: texts of the ids of entities that the fault does not concern, and of which there was an alarm more.
        why: why it cannot be seen, where it was not tried.
    """

    fault: Fault
    seen: bool
    after_s: float | None = None
    by: tuple[str, ...] = ()
    beside: tuple[str, ...] = ()
    why: str = ""


Opened = Callable[[float, float, "Fault | None"], Recording]
"""Returns a stretch of the recording as a recording, with a fault or without."""


def margins(reference: Reference) -> tuple[float, float]:
    """Return how many seconds have to be replayed before and after a fault."""
    timings = [one.details.timing for one in constraints_of(reference)]
    grace = max((one.grace for one in timings), default=0.0)
    window = max((one.window for one in timings), default=0.0)
    lasting = max((one.lasting for one in timings), default=0.0)
    return BEFORE_S + grace + window, AFTER_S + window + lasting


def planned(
    lanes: Mapping[tuple[str, str], float], start: float, end: float, before_s: float, after_s: float
) -> Iterator[Fault]:
    """Yield the faults to try: each kind of each topic once before any of them a second time, elsewhere.

    Args:
        lanes: by topic and publisher the mean period in seconds.
        start: seconds of its first message.
        end: seconds of its last message.
        before_s: how much of it has to be there before a fault.
        after_s: how much after it.
    """
    planned_before = set[Fault]()
    room = end - start - before_s - LENGTH_S - after_s
    places = max(int(room // LENGTH_S) + 1, 1) if room >= 0 else 0
    for turn in range(places):
        for shift, kind, topic, publisher in _of_one_turn(sorted(lanes)):
            begin = start + before_s + LENGTH_S * ((turn + shift) % places)
            length = min(max(LENGTH_S, LEAST_PERIODS * lanes[topic, publisher]), LENGTH_S + room)
            begin = min(begin, end - after_s - length)
            fault = Fault(kind, topic, publisher, begin, begin + length)
            if fault not in planned_before:
                planned_before.add(fault)
                yield fault


def _of_one_turn(lanes: Sequence[tuple[str, str]]) -> Iterator[tuple[int, FaultKind, str, str]]:
    """Yield each kind for each topic and publisher, behind by how many places it is shifted.

    Neighbours in the plan are far apart in the recording.
    """
    # A node vanishes once, not with each of its topics.
    of_node = {publisher: topic for topic, publisher in reversed(lanes) if publisher}
    for number, (topic, publisher) in enumerate(lanes):
        for place, kind in enumerate(FaultKind):
            if kind is not FaultKind.VANISHED_NODE or of_node.get(publisher) == topic:
                yield 7 * number + 3 * place, kind, topic, publisher


class Trials:
    """Replays stretches of a recording with faults, and once without for each stretch."""

    def __init__(self, reference: Reference, opened: Opened, margins_s: tuple[float, float]) -> None:
        self._reference = reference
        self._opened = opened
        self._before_s, self._after_s = margins_s
        self._healthy: dict[tuple[float, float], frozenset[tuple[str, str]]] = {}

    def run(self, fault: Fault, concerned: Sequence[tuple[str, str]]) -> Trial:
        """Try a fault; ``concerned`` are topics and publishers that it changes.

        Raises:
            UsageError: the recording does not have what it says.
        """
        begin, end = fault.begin_s - self._before_s, fault.end_s + self._after_s
        healthy = self._healthy.get((begin, end))
        if healthy is None:
            alarms = _alarms(self._opened(begin, end, None), self._reference)
            healthy = self._healthy[begin, end] = frozenset(_key(one) for one in alarms)
        broken = self._opened(begin, end, fault)
        alarms = _alarms(broken, self._reference, graphs(fault, broken.graph()))
        found = [one for one in alarms if _key(one) not in healthy]
        topics = {topic for topic, _ in concerned}
        nodes = {publisher for _, publisher in concerned if publisher}
        mine = [one for one in found if _about(one, topics, nodes) and _then(one, fault, self._after_s)]
        others = [one for one in found if not _about(one, topics, nodes)]
        return Trial(
            fault=fault,
            seen=bool(mine),
            after_s=min((max(one.reported - fault.begin_s, 0.0) for one in mine), default=None),
            by=tuple(sorted({one.first.expectation for one in mine})),
            beside=tuple(sorted({str(one.first.entity) for one in others})),
        )


def _alarms(
    recording: Recording, reference: Reference, graphs: Sequence[tuple[float, Graph]] = ()
) -> tuple[Alarm, ...]:
    log = AlarmLog()
    replay(recording, reference, report=lambda step: log.add(step.changes), graphs=graphs)
    return log.alarms()


def _key(alarm: Alarm) -> tuple[str, str]:
    return str(alarm.first.entity), alarm.first.expectation


def _about(alarm: Alarm, topics: set[str], nodes: set[str]) -> bool:
    entity = alarm.first.entity
    if entity.kind is EntityKind.CONNECTION:
        topic, publisher, _ = connection_ends(entity)
        return topic in topics or publisher in nodes
    # A chain that ends on a topic may have been broken at any one before.
    return entity.name in (topics if entity.kind is EntityKind.TOPIC else nodes) or alarm.first.quantity == "age"


def _then(alarm: Alarm, fault: Fault, after_s: float) -> bool:
    return fault.begin_s - EARLY_S <= alarm.reported <= fault.end_s + DELAY_S + after_s
