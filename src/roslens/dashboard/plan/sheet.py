"""The sheet on which a running system is drawn again and again: what stands somewhere stays there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.dashboard.plan.ground import Ground, Part, Wire
from roslens.dashboard.plan.plan import Plan, drawn_on

_MOST_NEW = 0.34
"""Share of new parts up to which everything else keeps its place."""
_MOST_EMPTY = 6
"""Columns in which nothing stands any more, of what came and went."""
_MOST_KEPT = 6000
"""Parts for which a place is kept, there or not."""
NOWHERE = Ground()
"""The ground of whoever knows none."""


class Sheet:
    """Remembers where everything stands.

    Attributes:
        version: how often something was placed, or a line drawn, anew.
        ground: on which everything was drawn last.
    """

    def __init__(self) -> None:
        self.version = 0
        self._given = self.ground = NOWHERE
        self._known: tuple[Sequence[Part], Sequence[Wire]] | None = None
        self._plan = Plan(0.0, 0.0, (), (), (), ())

    def of(self, parts: Sequence[Part], wires: Sequence[Wire], given: Ground = NOWHERE) -> Plan:
        """Return where everything stands.

        Args:
            parts: what is to be drawn now.
            wires: between them.
            given: a ground that holds, as that of the source of what runs; without one the sheet finds its own.
        """
        if (parts, wires) == self._known and given is self._given:
            return self._plan
        self.ground, self._plan = drawn_on(self._base(parts, given), parts, wires)
        self._given, self._known = given, (parts, wires)
        self.version += 1
        return self._plan

    def upon(self, parts: Sequence[Part], wires: Sequence[Wire], other: Ground) -> Plan:
        """Return where everything stands that another sheet has, or had, and what only this one ever had.

        Nothing gives up its place while the other ground is the same: what is there no more may be again.
        """
        if (parts, wires) == self._known and other is self._given:
            return self._plan
        base = self.ground if other is self._given and len(self.ground.stands) <= _MOST_KEPT else other
        self.ground, self._plan = drawn_on(base, parts, wires)
        self._given, self._known = other, (parts, wires)
        self.version += 1
        return self._plan

    def _base(self, parts: Sequence[Part], given: Ground) -> Ground:
        """Return the ground as it was, without what is there no more; an empty one where too much is new."""
        sizes = {part.key: part for part in parts}
        if given is not self._given:
            return given
        kept = {
            key: stand
            for key, stand in self.ground.stands.items()
            if key in given.stands
            or (key in sizes and (stand.width, stand.lane) == (sizes[key].width, sizes[key].lane))
        }
        empty = len(self.ground.spans) - len({stand.column for stand in kept.values()})
        if empty > _MOST_EMPTY or (not given.stands and len(sizes) - len(kept) > _MOST_NEW * len(sizes)):
            return given
        ways = _between(self.ground.ways, kept)
        lanes = {stand.lane for stand in kept.values()}
        reaches = tuple(reach for reach in self.ground.reaches if reach.lane in lanes)
        return msgspec.structs.replace(self.ground, stands=kept, ways=ways, reaches=reaches)


def _between(ways: Mapping[Wire, tuple[float, ...]], kept: Mapping[str, object]) -> dict[Wire, tuple[float, ...]]:
    return {wire: way for wire, way in ways.items() if wire[0] in kept and wire[1] in kept}
