"""The ways of wires through columns in which other things stand: by room that was kept, or between two elements."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable

from roslens.dashboard.plan.ground import ROOM, WAY, Ground, Stand

_LEVEL = 24.0
"""A wire that would rise or fall by less stays level."""
_BESIDE = ROOM / 2


class Gaps:
    """What stands in each column, from top to bottom."""

    def __init__(self, ground: Ground) -> None:
        columns: list[list[tuple[float, float]]] = [[] for _ in ground.spans]
        for stand in ground.stands.values():
            columns[stand.column].append((stand.y - stand.height / 2, stand.y + stand.height / 2))
        self._columns = [_merged(sorted(column)) for column in columns]

    def way(self, left: Stand, right: Stand) -> tuple[float, ...]:
        """Return heights for a wire at each column between its ends, near the straight line between them."""
        found = []
        y, end, last = left.y, right.y, right.column
        for column in range(left.column + 1, last):
            # It rises or falls by as much as is left of the way, shared by the columns that are left.
            rise = (end - y) / (last - column + 1)
            if not -_LEVEL < rise < _LEVEL:
                y += rise
            tops, bottoms = self._columns[column]
            place = bisect_left(bottoms, y - _BESIDE)
            if place < len(tops) and y > tops[place] - _BESIDE:
                above, below = tops[place] - _BESIDE, bottoms[place] + _BESIDE
                y = above if y - above <= below - y else below
            found.append(y)
        return tuple(found)


def _merged(found: Iterable[tuple[float, float]]) -> tuple[list[float], list[float]]:
    """Return tops and bottoms of what stands in a column; between two that touch nothing passes."""
    tops: list[float] = []
    bottoms: list[float] = []
    for top, bottom in found:
        if tops and top - bottoms[-1] < WAY:
            bottoms[-1] = max(bottom, bottoms[-1])
        else:
            tops.append(top)
            bottoms.append(bottom)
    return tops, bottoms
