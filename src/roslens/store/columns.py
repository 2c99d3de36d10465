"""Measurements by column: what the entities of one kind in one unit have of one quantity, as one JSON array.

An entity has some 25 values. As rows they would be most of the store; as columns they are written and read a unit at a
time, and a page about one quantity reads nothing else.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from operator import attrgetter

import msgspec

from roslens.model.entity import Entity, EntityKind
from roslens.store.rows import Row

_encode = msgspec.json.Encoder().encode
_decode = msgspec.json.Decoder(list[int | float | None]).decode

_ORDER = (EntityKind.PACKAGE, EntityKind.FILE, EntityKind.CLASS, EntityKind.FUNCTION)
_RANKS = {kind: rank for rank, kind in enumerate((*_ORDER, *(kind for kind in EntityKind if kind not in _ORDER)))}

Number = int | float


def by_kind(entities: Iterable[Entity]) -> list[Entity]:
    """Return the entities with those of a kind together: packages, files, classes, functions, others."""
    return sorted(entities, key=lambda entity: _RANKS[entity.kind])


def measured_rows(entities: Sequence[Entity]) -> Iterator[Row]:
    """Yield ``kind, quantity, first, values`` for entities that :func:`by_kind` put in order."""
    first = 0
    for kind, group in groupby(entities, key=attrgetter("kind")):
        values = [entity.values for entity in group]
        for quantity, numbers in _columns(values):
            yield kind.value, quantity, first, _encode(numbers).decode()
        first += len(values)


class Columns:
    """The measurements of one unit, for reading entity by entity."""

    def __init__(self, rows: Iterable[tuple[str, str, int, str]]) -> None:
        """Take rows of ``kind, quantity, first, values``."""
        self._kinds: dict[str, tuple[int, list[str], list[tuple[Number | None, ...]]]] = {}
        for kind, group in groupby(rows, key=lambda row: row[0]):
            found = list(group)
            numbers = zip(*(numbers_of(row[3]) for row in found), strict=True)
            self._kinds[kind] = (found[0][2], [row[1] for row in found], list(numbers))

    def values(self, kind: str, position: int) -> dict[str, float]:
        """Return what the entity of this kind at this position has, by quantity."""
        if kind not in self._kinds:
            return {}
        first, quantities, numbers = self._kinds[kind]
        own = numbers[position - first]
        if None in own:
            return {quantity: number for quantity, number in zip(quantities, own, strict=True) if number is not None}
        return dict(zip(quantities, own, strict=True))  # type: ignore[arg-type]


def columns_of(connection: sqlite3.Connection, unit: int, kind: str | None = None) -> Columns:
    """Read the measurements of a unit, or of its entities of one kind."""
    query = 'SELECT kind, quantity, first, "values" FROM measured WHERE unit = ?'
    wanted: tuple[object, ...] = (unit,)
    if kind is not None:
        query += " AND kind = ?"
        wanted = (unit, kind)
    return Columns(connection.execute(query + " ORDER BY kind, quantity", wanted))


def numbers_of(text: str) -> list[Number | None]:
    """Read a column."""
    return _decode(text)


def _columns(values: Sequence[Mapping[str, float]]) -> Iterator[tuple[str, Sequence[float | None]]]:
    quantities = tuple(values[0])
    if all(tuple(own) == quantities for own in values):
        yield from zip(quantities, zip(*(own.values() for own in values), strict=True), strict=True)
        return
    for quantity in dict.fromkeys(quantity for own in values for quantity in own):
        yield quantity, [own.get(quantity) for own in values]
