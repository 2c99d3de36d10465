"""The line of a wire: level through columns, bent between them, with an arrow where things flow to."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from roslens.dashboard.plan.ground import ROOM, Stand

TIP = 6.0
"""Length of the arrow at the end of a wire."""

TURN = 13.0
"""How far beside an element a wire that runs back turns round."""

Place = tuple[float, float]
Span = tuple[float, float]


class Tracks:
    """The room between columns, where wires bend."""

    def __init__(self, spans: Sequence[Span]) -> None:
        """``spans`` are from where to where each column reaches."""
        self.spans = spans
        self._bends = [
            (f"{left[1]:.1f}", f"{(left[1] + right[0]) / 2:.1f}", f"{right[0]:.1f}") for left, right in pairwise(spans)
        ]

    def rightward(self, column: int, y: str, height: str) -> str:
        """Return a bend behind a column."""
        if y == height:
            return ""
        start, middle, end = self._bends[column]
        return f"H{start}C{middle} {y} {middle} {height} {end} {height}"

    def leftward(self, column: int, y: str, height: str) -> str:
        """Return a bend before a column, of a wire that runs back."""
        if y == height:
            return ""
        end, middle, start = self._bends[column - 1]
        return f"H{start}C{middle} {y} {middle} {height} {end} {height}"

    def middle(self, column: int) -> float:
        """Return the middle between a column and the next."""
        return (self.spans[column][1] + self.spans[column + 1][0]) / 2


def trace(source: Stand, target: Stand, way: Sequence[float], tracks: Tracks) -> tuple[str, Place]:
    """Return the line as an SVG path, and where a word about it may stand.

    It leaves at the right side of an element and enters at the left side of another; one that runs back to an earlier
    column turns round beside both of its ends.

    Args:
        source: where it begins.
        target: where it ends.
        way: heights at the columns between, from left to right.
        tracks: the room between columns.
    """
    if source.column == target.column:
        return _within(source, target, tracks.spans[source.column])
    if source.column > target.column:
        return _back(source, target, way[::-1], tracks)
    y = f"{source.y:.1f}"
    parts = [f"M{source.x + source.width / 2:.1f} {y}"]
    for column, height in enumerate((*way, target.y), source.column):
        level = f"{height:.1f}"
        parts.append(tracks.rightward(column, y, level))
        y = level
    end = target.x - target.width / 2
    last = way[-1] if way else source.y
    word = (tracks.middle(target.column - 1), (last + target.y) / 2)
    return f"{''.join(parts)}H{end:.1f}{arrow(end, target.y)}", _rounded(word)


def _rounded(place: Place) -> Place:
    return round(place[0], 1), round(place[1], 1)


def _back(source: Stand, target: Stand, way: Sequence[float], tracks: Tracks) -> tuple[str, Place]:
    """Return a line to an earlier column; ``way`` has the heights from right to left."""
    right = source.x + source.width / 2
    begin = _beyond(source, way[0] if way else target.y)
    end = _beyond(target, way[-1] if way else source.y)
    parts = [f"M{right:.1f} {source.y:.1f}", _turn(right, source.y, begin, 1)]
    y = f"{begin:.1f}"
    for step, height in enumerate((*way, end)):
        level = f"{height:.1f}"
        parts.append(tracks.leftward(source.column - step, y, level))
        y = level
    word = (tracks.middle(target.column), ((way[-1] if way else begin) + end) / 2)
    return "".join((*parts, _entry(target, end))), _rounded(word)


def _within(source: Stand, target: Stand, span: Span) -> tuple[str, Place]:
    """Return a line to another element of the same column: it changes its row beside both, where nothing stands."""
    right, end = source.x + source.width / 2, _beyond(target, source.y)
    far = span[1]
    out = far + TURN + min(30.0, abs(source.y - target.y) / 8)
    line = f"M{right:.1f} {source.y:.1f}H{far:.1f}C{out:.1f} {source.y:.1f} {out:.1f} {end:.1f} {far:.1f} {end:.1f}"
    return line + _entry(target, end), _rounded((far + 0.75 * (out - far), (source.y + end) / 2))


def _beyond(one: Stand, towards: float) -> float:
    """Return the height between the row of an element and the next one in a direction."""
    return one.y + math.copysign(one.height / 2 + ROOM / 2, towards - one.y)


def _turn(x: float, y: float, to: float, direction: int) -> str:
    out = x + direction * TURN
    return f"C{out:.1f} {y:.1f} {out:.1f} {to:.1f} {x:.1f} {to:.1f}"


def _entry(target: Stand, y: float) -> str:
    """Return the end of a line that comes from the right: past the element, round, and into its left side."""
    left = target.x - target.width / 2
    return f"H{left:.1f}{_turn(left, y, target.y, -1)}{arrow(left, target.y)}"


def arrow(x: float, y: float) -> str:
    """Return the tip of a wire that comes from the left."""
    back = x - TIP
    return f"M{back:.1f} {y - TIP / 2:.1f}L{x:.1f} {y:.1f}L{back:.1f} {y + TIP / 2:.1f}"
