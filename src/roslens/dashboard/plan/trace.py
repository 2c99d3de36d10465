"""The line of a wire: level through columns, bent between them, with an arrow where things flow to."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Sequence
from itertools import pairwise, product

from roslens.dashboard.plan.ground import ROOM, Ground, Stand

TIP = 6.0
"""Length of the arrow at the end of a wire."""

TURN = 13.0
"""How far beside an element a wire that runs back turns round."""

CORNER = 7.0
"""Radius of the corners of a wire that rises or falls between two columns."""

_GENTLE = 2 * CORNER
"""What rises or falls by less bends without corners."""
_FLAT = 0.05
"""Less is no bend at all."""
_WORDS = 34.0
_LEAST = 26.0
"""Room that tracks have at least."""

Place = tuple[float, float]
Span = tuple[float, float]


class Tracks:
    """The room between columns, where wires bend: what leaves at another height does so on a track of its own.

    A track belongs to a height at which something stands or passes on the left of that room. Those of wires that rise
    are in the order of these heights, those of wires that fall in the opposite one: so two of them cross nowhere but
    where their ends make them. Tracks follow from the ground alone, and stay while others come and go.
    """

    def __init__(self, ground: Ground) -> None:
        self.spans = ground.spans
        found: list[set[float]] = [set() for _ in self.spans]
        for stand in ground.stands.values():
            found[stand.column].add(stand.y)
        for (start, end), heights in ground.ways.items():
            if start in ground.stands and end in ground.stands:
                first = min(ground.stands[start].column, ground.stands[end].column)
                for step, height in enumerate(heights, 1):
                    found[first + step].add(height)
        self._heights = [sorted(heights) for heights in found]
        self._rooms = [_room(left[1], right[0]) for left, right in pairwise(self.spans)]
        self._known = [
            {height: _pair(place, len(heights), *room) for place, height in enumerate(heights)}
            for heights, room in zip(self._heights, self._rooms, strict=False)
        ]

    def rightward(self, column: int, y: float, height: float) -> str:
        """Return a bend behind a column."""
        if abs(y - height) < _FLAT:
            return ""
        start, end = self.spans[column][1], self.spans[column + 1][0]
        if abs(y - height) <= _GENTLE:
            return _bent(start, y, end, height)
        return _stepped(self.track(column, y, height), y, height, 1)

    def leftward(self, column: int, y: float, height: float) -> str:
        """Return a bend before a column, of a wire that runs back."""
        if abs(y - height) < _FLAT:
            return ""
        end, start = self.spans[column - 1][1], self.spans[column][0]
        if abs(y - height) <= _GENTLE:
            return _bent(start, y, end, height)
        return _stepped(self.track(column - 1, height, y), y, height, -1)

    def track(self, column: int, left: float, right: float) -> float:
        """Return where a wire between two heights changes from one to the other, behind a column."""
        known = self._known[column].get(left)
        if known is not None:
            return known[right < left]
        start, wide = self._rooms[column]
        heights = self._heights[column]
        place = bisect_left(heights, left)
        number = float(place) if right < left else max(0.0, len(heights) - place - 0.5)
        return start + wide * number / (len(heights) or 1)


def _pair(place: int, count: int, start: float, wide: float) -> tuple[float, float]:
    """Return the two tracks of a height, for what falls and for what rises; other heights have theirs between."""
    return start + wide * (count - place - 0.75) / count, start + wide * (place + 0.75) / count


def _room(start: float, end: float) -> tuple[float, float]:
    """Return where the tracks between two columns begin, and how wide the room for them is.

    Words about what arrives stand before the next column, where that leaves room for tracks.
    """
    wide = end - start - 2 * CORNER
    return start + CORNER, wide - min(_WORDS, max(0.0, wide - _LEAST))


def _bent(start: float, y: float, end: float, height: float) -> str:
    middle = (start + end) / 2
    return f"H{start:.1f}C{middle:.1f} {y:.1f} {middle:.1f} {height:.1f} {end:.1f} {height:.1f}"


def _corners(direction: int, *, falls: bool, back: bool) -> tuple[str, str]:
    """Return the corners in which a line turns up or down and level again, relative to where each begins."""
    across, down = direction * CORNER, CORNER if falls else -CORNER
    return f"q{across:g} 0 {across:g} {down:g}", f"q0 {down:g} {-across if back else across:g} {down:g}"


_CORNERS = {
    (direction, falls, back): _corners(direction, falls=falls, back=back)
    for direction, falls, back in product((1, -1), (True, False), (True, False))
}


def _stepped(x: float, y: float, height: float, direction: int, *, back: bool = False) -> str:
    """Return a line that turns up or down at ``x``, and at a height back into its direction, or against it."""
    falls = height > y
    into, out = _CORNERS[direction, falls, back]
    return f"H{x - direction * CORNER:.1f}{into}V{height - CORNER if falls else height + CORNER:.1f}{out}"


def trace(source: Stand, target: Stand, way: Sequence[float], tracks: Tracks) -> tuple[str, Place]:
    """Return the line as an SVG path, and where a word about it may stand: halfway, where it rises or falls.

    It leaves at the right side of an element and enters at the left side of another; one that runs back to an earlier
    column turns round beside both of its ends.

    Args:
        source: where it begins.
        target: where it ends.
        way: heights at the columns between, from left to right.
        tracks: the room between columns.
    """
    if source.column == target.column:
        return _within(source, target, tracks)
    if source.column > target.column:
        return _back(source, target, way[::-1], tracks)
    y = source.y
    parts = [f"M{source.x + source.width / 2:.1f} {y:.1f}"]
    for column, height in enumerate((*way, target.y), source.column):
        parts.append(tracks.rightward(column, y, height))
        y = height
    end = target.x - target.width / 2
    last = way[-1] if way else source.y
    word = tracks.track(target.column - 1, last, target.y), (last + target.y) / 2
    return f"{''.join(parts)}H{end:.1f}{ARROW}", _rounded(word)


def _rounded(place: Place) -> Place:
    return round(place[0], 1), round(place[1], 1)


def _back(source: Stand, target: Stand, way: Sequence[float], tracks: Tracks) -> tuple[str, Place]:
    """Return a line to an earlier column; ``way`` has the heights from right to left."""
    right = source.x + source.width / 2
    begin = _beyond(source, way[0] if way else target.y)
    end = _beyond(target, way[-1] if way else source.y)
    parts = [f"M{right:.1f} {source.y:.1f}", _turn(right, source.y, begin, 1)]
    y = begin
    for step, height in enumerate((*way, end)):
        parts.append(tracks.leftward(source.column - step, y, height))
        y = height
    last = way[-1] if way else begin
    word = tracks.track(target.column, end, last), (last + end) / 2
    return "".join((*parts, _entry(target, end))), _rounded(word)


def _within(source: Stand, target: Stand, tracks: Tracks) -> tuple[str, Place]:
    """Return a line to another element of the same column: it changes its row beside both, where nothing stands."""
    right, end = source.x + source.width / 2, _beyond(target, source.y)
    far = tracks.spans[source.column][1]
    begin = f"M{right:.1f} {source.y:.1f}"
    if source.column < len(tracks.spans) - 1 and abs(source.y - end) > _GENTLE:
        x = tracks.track(source.column, source.y, end)
        line = f"{begin}{_stepped(x, source.y, end, 1, back=True)}H{far:.1f}"
        return line + _entry(target, end), _rounded((x, (source.y + end) / 2))
    out = far + TURN + min(30.0, abs(source.y - target.y) / 8)
    line = f"{begin}H{far:.1f}C{out:.1f} {source.y:.1f} {out:.1f} {end:.1f} {far:.1f} {end:.1f}"
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
    return f"H{left:.1f}{_turn(left, y, target.y, -1)}{ARROW}"


ARROW = f"m{-TIP:g} {-TIP / 2:g}l{TIP:g} {TIP / 2:g}l{-TIP:g} {TIP / 2:g}"
"""The tip of a wire that comes from the left, drawn from its end."""
