"""The ways of wires through columns in which other things stand: by room that was kept, or between two elements."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable

from roslens.dashboard.plan.ground import ROOM, WAY, Ground, Stand

_LEVEL = 24.0
"""A wire that would rise or fall by less stays level."""


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
        y, across = left.y, right.column - left.column
        for step in range(1, across):
            straight = y + (right.y - y) / (across - step + 1)
            y = self._near(left.column + step, y if abs(straight - y) < _LEVEL else straight)
            found.append(y)
        return tuple(found)

    def _near(self, column: int, wanted: float) -> float:
        tops, bottoms = self._columns[column]
        place = bisect_left(bottoms, wanted - ROOM / 2)
        if place == len(tops) or wanted <= tops[place] - ROOM / 2:
            return round(wanted, 1)
        above, below = tops[place] - ROOM / 2, bottoms[place] + ROOM / 2
        return round(above if wanted - above <= below - wanted else below, 1)


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
