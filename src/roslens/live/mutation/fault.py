"""Faults that are put into the traffic of a topic: what each of them does to the messages of a stretch of time."""

from __future__ import annotations

from enum import Enum
from typing import TypeAlias

import msgspec
import numpy as np
import numpy.typing as npt

from roslens.model.graph import Graph

Ints: TypeAlias = npt.NDArray[np.int64]
Traffic: TypeAlias = "tuple[Ints, Ints, Ints | None]"
"""Times of receipt, sizes and stamps of messages, by time; nanoseconds, bytes."""

_SECOND = 1_000_000_000
GAP_PERIODS = 5
LEAST_GAP_S = 0.5
LOST_SHARE = 0.2
DELAY_S = 0.5
SEED = 14
"""Of what is lost by chance: the same for every run."""


class FaultKind(str, Enum):
    """What is wrong in the stretch.

    - rate halved: every second message of the topic is left out
    - gap: nothing comes for five mean periods, at least 0.5 s
    - drop-out: one message in five is lost, by chance
    - delay: every message is received 0.5 s later; its stamp stays
    - wrong value: fields that the reference is about are far from all values they have in the recording
    - dead publisher: nothing comes any more, on any topic of the publisher where the recording knows it
    - vanished node: the same, and the node is not in the graph any more; of publishers that the recording knows
    """

    RATE_HALVED = "rate halved"
    GAP = "gap"
    DROP_OUT = "drop-out"
    DELAY = "delay"
    WRONG_VALUE = "wrong value"
    DEAD_PUBLISHER = "dead publisher"
    VANISHED_NODE = "vanished node"


SILENT = (FaultKind.DEAD_PUBLISHER, FaultKind.VANISHED_NODE)
"""After which nothing comes any more from the publisher."""


class Fault(msgspec.Struct, frozen=True, order=True):
    """A fault of a topic from ``begin_s`` to ``end_s``, seconds on the clock of the recording.

    ``publisher`` is empty where the recording does not know it.
    """

    kind: FaultKind
    topic: str
    publisher: str
    begin_s: float
    end_s: float

    def concerns(self, topic: str, publisher: str) -> bool:
        """Whether it changes what a node publishes on a topic."""
        if self.kind in SILENT and self.publisher:
            return publisher == self.publisher
        return (topic, publisher) == (self.topic, self.publisher)


def changed(fault: Fault, traffic: Traffic) -> Traffic:
    """Return the messages as they would have been received with the fault."""
    times, sizes, stamps = traffic
    begin, end = round(fault.begin_s * _SECOND), round(fault.end_s * _SECOND)
    inside = (times >= begin) & (times < end)
    if fault.kind is FaultKind.DELAY:
        later = np.where(inside, times + round(DELAY_S * _SECOND), times)
        order = np.argsort(later, kind="stable")
        return later[order], sizes[order], stamps if stamps is None else stamps[order]
    left_out = _left_out(fault.kind, times, inside, begin)
    return times[~left_out], sizes[~left_out], stamps if stamps is None else stamps[~left_out]


def graphs(fault: Fault, graph: Graph) -> tuple[tuple[float, Graph], ...]:
    """Return the graphs that a fault makes of one, each with the seconds from which on it is so; none of most."""
    if fault.kind is not FaultKind.VANISHED_NODE:
        return ()
    without = msgspec.structs.replace(
        graph,
        nodes=tuple(one for one in graph.nodes if one.name != fault.publisher),
        endpoints=tuple(one for one in graph.endpoints if one.node != fault.publisher),
    )
    return ((fault.begin_s, without), (fault.end_s, graph))


def _left_out(kind: FaultKind, times: Ints, inside: npt.NDArray[np.bool_], begin: int) -> npt.NDArray[np.bool_]:
    if kind in SILENT:
        return inside
    if kind is FaultKind.RATE_HALVED:
        second: npt.NDArray[np.bool_] = np.cumsum(inside) % 2 == 0
        return inside & second
    if kind is FaultKind.DROP_OUT:
        lost: npt.NDArray[np.bool_] = np.random.default_rng(SEED).random(len(times)) < LOST_SHARE
        return inside & lost
    if kind is FaultKind.GAP:
        within: npt.NDArray[np.bool_] = times < begin + _gap(times)
        return inside & within
    return np.zeros(len(times), np.bool_)


def _gap(times: Ints) -> int:
    """Return nanoseconds of the gap that is made in a topic."""
    mean = (int(times[-1]) - int(times[0])) / (len(times) - 1) if len(times) > 1 else 0.0
    return round(max(GAP_PERIODS * mean, LEAST_GAP_S * _SECOND))


def wrong_value(values: npt.NDArray[np.float64]) -> float:
    """Return a value that is far from all of these: ten times as far from the middle as any, and ten at least."""
    low, high = float(values.min()), float(values.max())
    return high + max(10 * (high - low), 10 * abs(high), 10.0)
