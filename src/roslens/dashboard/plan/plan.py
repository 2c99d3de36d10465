"""A computation graph as it is drawn: what is on a ground, with boxes and lines; the same wherever it is looked at."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.dashboard.plan.boxes import boxes_of
from roslens.dashboard.plan.columns import columns_of
from roslens.dashboard.plan.gaps import Gaps
from roslens.dashboard.plan.ground import EDGE, PAD, Box, Ground, Part, Stand, Wire
from roslens.dashboard.plan.grow import grow
from roslens.dashboard.plan.survey import survey
from roslens.dashboard.plan.trace import TIP, Place, Tracks, trace


class Plan(msgspec.Struct, frozen=True):
    """Where everything stands, in the units of the picture.

    Attributes:
        width: of the picture.
        height: of the picture.
        places: the middle of each part.
        boxes: of hosts and namespaces, outer ones first.
        paths: a line for each wire.
        words: where a word about each wire may stand; of one to a topic where it ends, before that.
    """

    width: float
    height: float
    places: tuple[Place, ...]
    boxes: tuple[Box, ...]
    paths: tuple[str, ...]
    words: tuple[Place, ...]


def ground_of(parts: Sequence[Part], wires: Sequence[Wire]) -> Ground:
    """Return a new ground for a graph; the same for the same graph, in whatever order it is given."""
    ordered = sorted(parts, key=lambda part: part.key)
    ordered_wires = sorted(set(wires))
    return survey(ordered, columns_of(ordered, ordered_wires), ordered_wires)


def plan(ground: Ground, parts: Sequence[Part], wires: Sequence[Wire]) -> Plan:
    """Draw on a ground what has a place there."""
    stands = ground.stands
    gaps, tracks = Gaps(ground), Tracks(ground)
    lines = [trace(stands[start], stands[end], _way(ground, gaps, start, end), tracks) for start, end in wires]
    nodes = {part.key for part in parts if part.node}
    words = [word if end in nodes else _before(stands[end]) for (_, end), (_, word) in zip(wires, lines, strict=True)]
    boxes = boxes_of(ground)
    right = max((end for _, end in ground.spans), default=0.0) + PAD
    bottom = max(ground.bottom, max((box.y + box.height for box in boxes), default=0.0))
    return Plan(
        width=round(right + EDGE, 1),
        height=round(bottom + EDGE, 1),
        places=tuple((stands[part.key].x, stands[part.key].y) for part in parts),
        boxes=boxes,
        paths=tuple(path for path, _ in lines),
        words=tuple(words),
    )


def drawn_on(ground: Ground, parts: Sequence[Part], wires: Sequence[Wire]) -> tuple[Ground, Plan]:
    """Return the ground with a place for each part, and what is drawn on it; an empty ground is surveyed anew."""
    if not ground.stands:
        ground = ground_of(parts, wires)
    ground = grow(ground, parts, wires)
    return ground, plan(ground, parts, wires)


def _way(ground: Ground, gaps: Gaps, start: str, end: str) -> tuple[float, ...]:
    first, last = sorted((ground.stands[start], ground.stands[end]), key=_column)
    between = last.column - first.column - 1
    if between < 1:
        return ()
    known = ground.ways.get((start, end))
    return known if known is not None and len(known) == between else gaps.way(first, last)


def _before(stand: Stand) -> Place:
    """Return where a word about what arrives at a topic ends: before its mark, where no other line arrives."""
    return round(stand.x - stand.width / 2 - TIP - 2, 1), stand.y


def _column(stand: Stand) -> int:
    return stand.column
