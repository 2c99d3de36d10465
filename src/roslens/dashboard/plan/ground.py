"""The ground on which a computation graph is drawn: columns, boxes, and the place that each name has there.

A ground is surveyed once (:mod:`roslens.dashboard.plan.survey`); whatever is drawn on it later, of source or of what
runs, finds its place by its name, and what is new there takes room that is free (:mod:`roslens.dashboard.plan.grow`).
"""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

GAP = 54.0
ROOM = 10.0
"""Between two elements of a column; wires pass there."""

WAY = 8.0
PAD = 12.0
HEAD = 20.0
BETWEEN = 16.0
EDGE = 16.0

Wire = tuple[str, str]
"""From whom to whom, by their keys."""


class Part(msgspec.Struct, frozen=True):
    """What is to be drawn.

    Attributes:
        key: names it, on every page alike: ``node:/lidar``, ``topic:/scan``.
        width: of its box, with its name.
        height: of its box.
        lane: the namespace in whose box it stands; with ``@host`` before it where hosts are distinguished.
        node: whether it is a node; everything else joins nodes.
        quiet: whether it does not affect the placement of nodes, such as ``/rosout``.
    """

    key: str
    width: float
    height: float
    lane: str = "/"
    node: bool = True
    quiet: bool = False


class Stand(msgspec.Struct, frozen=True):
    """Where a part stands: its middle, its size, its column and its lane."""

    x: float
    y: float
    width: float
    height: float
    column: int
    lane: str


class Reach(msgspec.Struct, frozen=True):
    """From where to where the elements of a lane stand."""

    lane: str
    top: float
    bottom: float


class Box(msgspec.Struct, frozen=True):
    """The box of a host or namespace; ``depth`` is in how many others it stands."""

    name: str
    x: float
    y: float
    width: float
    height: float
    depth: int
    title: str = ""


class Ground(msgspec.Struct, frozen=True):
    """Columns from left to right, who stands where, the heights at which wires pass the columns between their ends.

    ``ways`` has these heights from left to right, whichever way the wire goes.
    """

    spans: tuple[tuple[float, float], ...] = ()
    stands: Mapping[str, Stand] = {}
    ways: Mapping[Wire, tuple[float, ...]] = {}
    reaches: tuple[Reach, ...] = ()

    @property
    def bottom(self) -> float:
        """Below everything."""
        return max((one.bottom for one in self.reaches), default=EDGE)


def parts_of(lane: str) -> tuple[str, ...]:
    """Return host and namespaces of a lane, outermost first."""
    return tuple(part for part in lane.split("/") if part)
