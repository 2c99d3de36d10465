"""One quantity across a run: what a page about a metric shows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from heapq import nsmallest
from operator import itemgetter

from roslens.model.entity import Entity, EntityKind
from roslens.store import rows
from roslens.store.columns import Number, columns_of, numbers_of
from roslens.store.question import Conditions, Run

PackageValues = Mapping[str, Mapping[str, float]]
"""Package id to quantity to value, of the quantities that need all packages; likewise by the text form of its id, of
files, what the history of their repository says."""

_Column = tuple[int, str, int, list[Number | None]]
"""Unit, package id, position of the first entity, a number for it and each one behind it."""


def all_numbers(run: Run, package_values: PackageValues, quantity: str, kind: EntityKind) -> list[float]:
    """Return every value of the quantity among entities of the kind."""
    columns = _columns(run, package_values, quantity, kind)
    return [number for column in columns for number in column[3] if number is not None]


def named_numbers(
    run: Run, package_values: PackageValues, quantity: str, kind: EntityKind
) -> list[tuple[str, str, float]]:
    """Return entity id, package id and value of every entity of the kind that has the quantity."""
    found = []
    for unit, package, first, numbers in _columns(run, package_values, quantity, kind):
        with run.reading() as connection:
            identities = connection.execute(
                "SELECT id FROM entity WHERE unit = ? AND position >= ? AND position < ? ORDER BY position",
                (unit, first, first + len(numbers)),
            ).fetchall()
        for (identity,), number in zip(identities, numbers, strict=True):
            if number is not None:
                found.append((identity, package, number))
    return found


def extreme_numbers(
    run: Run, package_values: PackageValues, quantity: str, kind: EntityKind, count: int, *, highest: bool
) -> list[tuple[Entity, str, float]]:
    """Return entity, package id and value of the ``count`` highest or lowest values, the most extreme first."""
    sign = -1 if highest else 1
    columns = list(_columns(run, package_values, quantity, kind))
    worst = nsmallest(count, (sign * number for column in columns for number in column[3] if number is not None))
    if not worst:
        return []
    ranked = [
        (sign * number, unit, first + place, package)
        for unit, package, first, numbers in columns
        for place, number in enumerate(numbers)
        if number is not None and sign * number <= worst[-1]
    ]
    ranked.sort(key=itemgetter(0))
    return [
        (_entity_at(run, package_values, unit, position), package, sign * number)
        for number, unit, position, package in ranked[:count]
    ]


def _columns(run: Run, package_values: PackageValues, quantity: str, kind: EntityKind) -> Iterator[_Column]:
    where = Conditions()
    where.equal("measured.kind", kind.value)
    where.equal("measured.quantity", quantity)
    found = run.rows(
        'run_unit.unit, unit.package, measured.first, measured."values"', "measured", where, unit=True, order="first"
    )
    columns = ((unit, package, first, numbers_of(text)) for unit, package, first, text in found)
    if kind is not EntityKind.PACKAGE:
        yield from columns
        return
    own = {unit: numbers for unit, _package, _first, numbers in columns}
    for unit, package in _package_units(run):
        shared = package_values.get(package, {}).get(quantity)
        yield (unit, package, 0, own.get(unit, [None]) if shared is None else [shared])


def _package_units(run: Run) -> Iterator[tuple[int, str]]:
    """Yield units and package ids of the packages that have an entity; it is the first of its unit."""
    where = Conditions()
    where.equal("entity.position", 0)
    where.equal("entity.kind", EntityKind.PACKAGE.value)
    yield from run.rows("run_unit.unit, unit.package", "entity", where, unit=True)


def _entity_at(run: Run, package_values: PackageValues, unit: int, position: int) -> Entity:
    with run.reading() as connection:
        row = connection.execute(
            f"SELECT {rows.ENTITY} FROM entity WHERE unit = ? AND position = ?",  # noqa: S608 - column names of rows.py
            (unit, position),
        ).fetchone()
        values = columns_of(connection, unit, row[1]).values(row[1], position)
    return rows.to_entity(row, with_package_values(row[0], values, package_values))


def with_package_values(identity: str, values: dict[str, float], package_values: PackageValues) -> dict[str, float]:
    """Return the values of an entity, with what is known of a package or file besides what it contains."""
    kind, _, name = identity.partition(":")
    more = package_values.get(name if kind == EntityKind.PACKAGE.value else identity)
    return {**values, **more} if more else values
