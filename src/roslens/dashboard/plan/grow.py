"""What is new on a ground: it takes room that is free, and what stands somewhere stays there."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence

import msgspec

from roslens.dashboard.plan.ground import (
    BETWEEN,
    EDGE,
    GAP,
    HEAD,
    PAD,
    ROOM,
    Ground,
    Part,
    Reach,
    Stand,
    Wire,
    parts_of,
)

_NEAR = 3
"""So many columns aside from where it belongs something may stand before it gets a column of its own."""


def grow(ground: Ground, parts: Sequence[Part], wires: Iterable[Wire]) -> Ground:
    """Return the ground with a place for every part that has none yet: beside what it is joined to, in its lane.

    Where its lane has no room for it, there is a second lane of that name at the bottom of the picture.
    """
    new = {part.key: part for part in parts if part.key not in ground.stands}
    if not new:
        return ground
    before: dict[str, list[str]] = {}
    after: dict[str, list[str]] = {}
    for start, end in sorted(wires):
        before.setdefault(end, []).append(start)
        after.setdefault(start, []).append(end)
    field = _Field(ground)
    for key in _ordered(new, before, after, field.stands):
        lefts = [field.stands[one] for one in before.get(key, ()) if one in field.stands]
        rights = [field.stands[one] for one in after.get(key, ()) if one in field.stands]
        field.place(new[key], lefts, rights)
    return msgspec.structs.replace(ground, spans=tuple(field.spans), stands=field.stands, reaches=tuple(field.reaches))


def _ordered(
    new: Mapping[str, Part],
    before: Mapping[str, Sequence[str]],
    after: Mapping[str, Sequence[str]],
    stands: Mapping[str, Stand],
) -> list[str]:
    """Return the new ones in the order in which they are placed: first those that are joined to what has a place."""

    def near(key: str) -> list[str]:
        return [*before.get(key, ()), *after.get(key, ())]

    waiting = sorted(new)
    first = [key for key in waiting if any(other in stands for other in near(key))]
    found: dict[str, None] = {}
    for seed in [*first, *waiting]:
        open_ = deque([seed] if seed not in found else [])
        while open_:
            key = open_.popleft()
            if key not in found:
                found[key] = None
                # Those joined to a place already have their turn by themselves.
                open_ += [one for one in sorted(near(key)) if one in new and one not in found and not first]
    return list(found)


class _Field:
    """The ground while it grows."""

    def __init__(self, ground: Ground) -> None:
        self.spans = list(ground.spans)
        self.stands = dict(ground.stands)
        self.reaches = list(ground.reaches)
        self._taken: list[list[tuple[float, float]]] = [[] for _ in self.spans]
        for stand in self.stands.values():
            self._take(stand.column, stand.y, stand.height)
        for (start, end), heights in ground.ways.items():
            if start in self.stands and end in self.stands:
                column = min(self.stands[start].column, self.stands[end].column)
                for step, height in enumerate(heights, 1):
                    self._take(column + step, height, 0.0)

    def place(self, part: Part, lefts: Sequence[Stand], rights: Sequence[Stand]) -> None:
        near = [one.y for one in (*lefts, *rights)]
        wanted = sum(near) / len(near) if near else EDGE
        column = self._column(lefts, rights)
        fitting = [one for one in self._nearest(column) if self.spans[one][1] - self.spans[one][0] >= part.width]
        for one in fitting:
            found = self._free(part, one, wanted)
            if found is not None:
                self._stand(part, one, found)
                return
        if not fitting:
            column = self._new_column(part.width)
            found = self._free(part, column, wanted)
            if found is not None:
                self._stand(part, column, found)
                return
        else:
            column = fitting[0]
        self._stand(part, column, self._below(part))

    def _column(self, lefts: Sequence[Stand], rights: Sequence[Stand]) -> int:
        if lefts:
            return max(one.column for one in lefts) + 1
        return max(0, min((one.column for one in rights), default=1) - 1)

    def _nearest(self, column: int) -> list[int]:
        """Return columns to try, the nearest first; none for what has to stand right of all."""
        if column >= len(self.spans):
            return []
        near = [one for one in range(column - _NEAR, column + _NEAR + 1) if 0 <= one < len(self.spans)]
        return sorted(near, key=lambda one: (abs(one - column), one < column))

    def _new_column(self, width: float) -> int:
        left = self.spans[-1][1] + GAP + PAD if self.spans else EDGE + PAD
        self.spans.append((left, round(left + width, 1)))
        self._taken.append([])
        return len(self.spans) - 1

    def _free(self, part: Part, column: int, wanted: float) -> float | None:
        """Return the free middle nearest to ``wanted`` in a lane of that name; None where there is no room."""
        last = max(range(len(self.reaches)), key=lambda at: self.reaches[at].bottom, default=-1)
        rooms = []
        for place, reach in enumerate(self.reaches):
            if reach.lane == part.lane:
                bottom = float("inf") if place == last else reach.bottom
                rooms += self._rooms(column, reach.top, bottom, part.height)
        fits = [min(max(wanted, first), end) for first, end in rooms]
        return min(fits, key=lambda y: (abs(y - wanted), y), default=None)

    def _rooms(self, column: int, top: float, bottom: float, height: float) -> list[tuple[float, float]]:
        """Return from where to where the middle of something of this height may be."""
        found = []
        at = top
        for first, end in sorted(self._taken[column]):
            if first >= bottom:
                break
            if first - at >= height + ROOM:
                found.append((at + (height + ROOM) / 2, first - (height + ROOM) / 2))
            at = max(at, end)
        if bottom - at >= height + ROOM:
            found.append((at + (height + ROOM) / 2, bottom - (height + ROOM) / 2))
        return found

    def _below(self, part: Part) -> float:
        """Return a place in a new lane below all others."""
        before = self.reaches[-1].lane if self.reaches else ""
        bottom = max((one.bottom for one in self.reaches), default=EDGE)
        depth = len(parts_of(part.lane))
        top = bottom + len(parts_of(before)) * PAD + (BETWEEN if self.reaches else 0.0) + depth * HEAD
        self.reaches.append(Reach(part.lane, top, top))
        return top + (part.height + ROOM) / 2

    def _stand(self, part: Part, column: int, y: float) -> None:
        y = round(y, 1)
        x = round(sum(self.spans[column]) / 2, 1)
        self.stands[part.key] = Stand(x, y, part.width, part.height, column, part.lane)
        self._take(column, y, part.height)
        below = round(y + (part.height + ROOM) / 2, 1)
        last = max(range(len(self.reaches)), key=lambda at: self.reaches[at].bottom)
        if below > self.reaches[last].bottom:
            self.reaches[last] = msgspec.structs.replace(self.reaches[last], bottom=below)

    def _take(self, column: int, y: float, height: float) -> None:
        self._taken[column].append((y - (height + ROOM) / 2, y + (height + ROOM) / 2))
