"""What a running system says: who is there, what was counted, who ended, which programs of ROS run apart."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from roslens.compare.why.recorded import RecordedTransforms
from roslens.model.answers.ros_process import RosProcess
from roslens.model.graph import Graph


class Ended(msgspec.Struct, frozen=True):
    """A node that ended while it was looked at: how, and the last lines of its log."""

    node: str
    how: str
    said: tuple[str, ...] = ()


class ObservedTransforms(msgspec.Struct, frozen=True):
    """Transforms that were heard from ``start`` to ``end``, in seconds since the epoch."""

    said: RecordedTransforms
    start: float
    end: float


class Observed(msgspec.Struct, frozen=True):
    """What a running system says.

    Attributes:
        title: what was looked at.
        graph: nodes and ends.
        values: latest values by id of an entity and key of a signal.
        seconds: how long it was looked at; 0 where it is looked at all the time.
        ended: nodes that ended meanwhile.
        failures: what observers could not do, a sentence each.
        processes: of ROS 2 on this host, as far as they can be read.
        unreadable: how many processes of other users could not be looked into.
        closed_memory: users of this host who share memory of Fast DDS that others may not write.
        routers: how many routers of Zenoh run on this host.
        user: numeric id of who looked; None where that is not known.
        transforms: what was heard of frames, with since and until when; None where it was not listened.
        here: domain, middleware and discovery range that were looked at, by the name of their variable.
    """

    title: str
    graph: Graph
    values: Mapping[str, Mapping[str, float]] = {}
    seconds: float = 0.0
    ended: tuple[Ended, ...] = ()
    failures: tuple[str, ...] = ()
    processes: tuple[RosProcess, ...] = ()
    unreadable: int = 0
    closed_memory: frozenset[int] = frozenset()
    routers: int = 0
    user: int | None = None
    transforms: ObservedTransforms | None = None
    here: Mapping[str, str] = {}
