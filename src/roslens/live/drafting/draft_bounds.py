"""Bounds that are proposed of what was measured once a second: loss, age, latency, publishers, misfits, load, calls.

A bound is the greatest value that may well come again, which is the one after as many as `alarms_allowed`, and room
above it: a share of it, or what is too little to matter of its signal, whichever is more. What is counted is expected
as it was. A line is steady where the bound of the first half of what was measured holds in the second half: what grew,
or happened to be small at first, is proposed but left out until a person has looked at it.
"""

from __future__ import annotations

import statistics
from array import array
from collections.abc import Iterable, Mapping, Sequence
from itertools import accumulate, pairwise

import msgspec

from roslens.judge.ranges.range import Range
from roslens.live.drafting.draft_lines import alarms_allowed, rounded
from roslens.live.drafting.draft_presence import MADE_UP, OF_MANY_NODES, PLUMBING
from roslens.model.entity import EntityId, EntityKind
from roslens.model.words.plural import plural

WINDOW = 5
"""Values that are judged together: those of five seconds, as the window of the constraint says."""
SETTLING_S = 5.0
"""So long after it was first seen, what is measured of an entity says more about its start than about itself."""
LEAST = 10
"""Of fewer values no bound is steady."""
_DIGITS = 2


class Room(msgspec.Struct, frozen=True):
    """How far above what was measured a bound is.

    Attributes:
        share: of the greatest value that may well come again.
        least: in the unit of the signal; less says nothing.
        most: values from here on are not what the signal is meant for; no bound is proposed.
    """

    share: float
    least: float
    most: float = float("inf")


_SECONDS = Room(1.0, 0.02, 10.0)
ROOM: Mapping[EntityKind, Mapping[str, Room]] = {
    EntityKind.TOPIC: {"loss": Room(0.5, 10.0, 80.0), "age": _SECONDS, "latency": _SECONDS},
    EntityKind.NODE: {"cpu": Room(0.5, 20.0), "memory": Room(0.25, 20e6)},
    EntityKind.HOST: {"cpu": Room(0.25, 20.0, 75.0), "memory_share": Room(0.1, 10.0, 85.0)},
    EntityKind.SERVICE: {"response_time": Room(1.0, 0.05, 60.0), "client_response_time": Room(1.0, 0.05, 60.0)},
}
"""By kind of entity and signal. Ages of more than ten seconds are those of stamps of another time."""
COUNTED = ("publishers", "misfits")


class Bound(msgspec.Struct, frozen=True):
    """One line that is proposed of an entity.

    Attributes:
        entity: that it is about.
        quantity: key of the signal.
        range: that is proposed, in the unit of the signal.
        typical: median of what was measured.
        outside: how often what was measured left the range.
        hours: that it was measured for.
        unsteady: why it is left out; empty of what is steady.
    """

    entity: EntityId
    quantity: str
    range: Range
    typical: float
    outside: int
    hours: float
    unsteady: str = ""


class Values:
    """Collects what is measured, look by look.

    Args:
        step_s: seconds from one look to the next.
    """

    def __init__(self, step_s: float) -> None:
        self._step_s = step_s
        self._kept: dict[tuple[EntityId, str], array[float]] = {}
        self._met: dict[EntityId, float] = {}

    def look(self, now: float, readings: Iterable[tuple[EntityId, Mapping[str, float]]]) -> None:
        """Take what is measured at ``now``."""
        for entity, values in readings:
            if now - self._met.setdefault(entity, now) < SETTLING_S or not _wanted(entity):
                continue
            keys = (*ROOM[entity.kind], *(COUNTED if entity.kind is EntityKind.TOPIC else ()))
            for key in keys:
                if key in values:
                    self._kept.setdefault((entity, key), array("d")).append(values[key])

    def drafted(self) -> tuple[Bound, ...]:
        """Return what is proposed, by entity and signal."""
        found = []
        for (entity, key), values in sorted(self._kept.items()):
            if key == "client_response_time" and (entity, "response_time") in self._kept:
                continue
            bound = self._counted(entity, key, values) if key in COUNTED else self._bounded(entity, key, values)
            if bound is not None:
                found.append(bound)
        return tuple(found)

    def _bounded(self, entity: EntityId, key: str, raw: Sequence[float]) -> Bound | None:
        room = ROOM[entity.kind][key]
        values = means(raw)
        hours = len(raw) * self._step_s / 3600
        range_ = bound_of(values, room, hours)
        if range_ is None:
            return None
        why = f"{len(raw)} values are too few" if len(raw) < LEAST else _left_later(raw, room, self._step_s)
        return Bound(entity, key, range_, statistics.median(values), _times_outside(values, range_), hours, why)

    def _counted(self, entity: EntityId, key: str, values: Sequence[float]) -> Bound | None:
        typical = statistics.mode(values)
        if key == "publishers" and not typical:
            return None
        range_ = Range(None if key == "misfits" and typical else typical, typical)
        changes = sum(one != other for one, other in pairwise(values))
        why = f"{len(values)} values are too few" if len(values) < LEAST else ""
        if changes > 0:
            why = f"from {min(values):g} to {max(values):g}, changed {plural(changes, 'time')}"
        return Bound(
            entity, key, range_, typical, _times_outside(values, range_), len(values) * self._step_s / 3600, why
        )


def bound_of(values: Sequence[float], room: Room, hours: float) -> Range | None:
    """Return the range up to what may well come again and room above it; None where that is beyond what is meant."""
    ordered = sorted(values, reverse=True)
    allowed = alarms_allowed(hours)
    again = ordered[min(allowed, len(ordered) - 1)]
    if again >= room.most:
        return None
    return Range(maximum=rounded(again + max(room.share * again, room.least), up=True, digits=_DIGITS))


def means(values: Sequence[float]) -> list[float]:
    """Return the means of so many values in a row as are judged together."""
    if len(values) <= WINDOW:
        return [statistics.fmean(values)]
    sums = list(accumulate(values, initial=0.0))
    return [(after - before) / WINDOW for before, after in zip(sums, sums[WINDOW:], strict=False)]


def _left_later(raw: Sequence[float], room: Room, step_s: float) -> str:
    """Return how often the bound of the first half is left in the second; empty where that is as seldom as allowed."""
    first, second = means(raw[: len(raw) // 2]), means(raw[len(raw) // 2 :])
    hours = len(raw) / 2 * step_s / 3600
    bound = bound_of(first, room, hours)
    if bound is None:
        return ""
    outside = _times_outside(second, bound)
    return f"a bound of its first half, {bound}, is left in the second" if outside else ""


def _wanted(entity: EntityId) -> bool:
    if entity.kind not in ROOM or entity.name in PLUMBING or MADE_UP.search(entity.name):
        return False
    return not (entity.kind is EntityKind.SERVICE and OF_MANY_NODES.search(entity.name))


def _times_outside(values: Sequence[float], range_: Range) -> int:
    inside = [value in range_ for value in values]
    return sum(not now and before for before, now in zip([True, *inside], inside, strict=False))
