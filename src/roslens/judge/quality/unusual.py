"""Where an entity stands in the field: in what is asked of it most, how many of a hundred others have less."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import msgspec

from roslens.judge.quality.field import CURRENT, Distribution, distributions_of
from roslens.model.entity import EntityKind

LOOKED_AT = {
    EntityKind.PACKAGE: (
        "cyclomatic_complexity.max", "cognitive_complexity.max", "nesting.max", "cbo.max", "duplication_ratio",
    ),
    EntityKind.FILE: ("cyclomatic_complexity.max", "cognitive_complexity.max", "nesting.max", "loc"),
    EntityKind.CLASS: ("wmc", "cbo", "lcom", "dit"),
    EntityKind.FUNCTION: ("cyclomatic_complexity", "cognitive_complexity", "nesting", "eloc", "parameters"),
}  # fmt: skip
"""Quantities of which more is worse, by kind of entity, that summarise how unusual an entity is."""


class Unusual(msgspec.Struct, frozen=True):
    """The quantity of an entity that stands highest in the field, its value, and how many of a hundred have less."""

    quantity: str
    value: float
    percentile: float


def most_unusual(kind: EntityKind, values: Mapping[str, float], *, field: str = CURRENT) -> Unusual | None:
    """Return what of an entity stands highest in the field; None where the field knows nothing of it.

    Args:
        kind: of the entity.
        values: by key of quantity.
        field: which one.
    """
    found: Unusual | None = None
    for key, distribution in _looked_at(kind, field):
        value = values.get(key)
        if value is None:
            continue
        percentile = distribution.percentile(value)
        if found is None or percentile > found.percentile:
            found = Unusual(key, value, percentile)
    return found


def percentiles(kind: EntityKind, values: Mapping[str, float], *, field: str = CURRENT) -> dict[str, float]:
    """Return for each value that the field knows how many of a hundred have less, with one decimal."""
    known = distributions_of(kind, field)
    return {key: round(known[key].percentile(value), 1) for key, value in sorted(values.items()) if key in known}


@lru_cache(maxsize=16)
def _looked_at(kind: EntityKind, field: str) -> tuple[tuple[str, Distribution], ...]:
    known = distributions_of(kind, field)
    return tuple((key, known[key]) for key in LOOKED_AT.get(kind, ()) if key in known)
