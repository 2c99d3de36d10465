"""The column of tables with the percentiles of entities in the field."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.dashboard.tables.table import Cell, Column
from roslens.judge.quality.unusual import LOOKED_AT, most_unusual
from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity

_MANY = {EntityKind.CLASS: "classes"}


def field_column(kind: EntityKind, *, optional: bool = False) -> Column:
    """Return the column."""
    keys = ", ".join(LOOKED_AT[kind])
    hint = f"How many of a hundred {_many(kind)} of known ROS packages have less, of the highest of {keys}"
    return Column("field", "Field", "number", unit="%", hint=hint, optional=optional)


def field_cell(kind: EntityKind, values: Mapping[str, float], quantities: Mapping[str, Quantity]) -> Cell:
    """Return where an entity stands; empty where the field knows nothing of it."""
    found = most_unusual(kind, values)
    if found is None:
        return Cell(None)
    key, _, fold = found.quantity.partition(".")
    title = quantities[key].title if key in quantities else key
    named = f"{title}{', most' if fold == 'max' else ''}"
    hint = f"{named} {found.value:.4g}: {found.percentile:.0f} of 100 {_many(kind)} of the field have less"
    return Cell(round(found.percentile), hint=hint)


def _many(kind: EntityKind) -> str:
    return _MANY.get(kind, f"{kind.value}s")
