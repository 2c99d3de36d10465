"""Halstead's time."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.halstead import halstead_effort

STROUD = 18
"""Elementary discriminations of the mind in a second (Stroud 1967), as Halstead took it."""

QUANTITY = Quantity(
    key="halstead_time",
    title="Halstead time",
    unit="s",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="How long it takes to write the code, by Halstead's estimate.",
    folds=(Fold.SUM, Fold.MAX),
    formula="T = E / 18",
    source="Halstead, Elements of Software Science, 1977",
    limits="The number 18 has no support in today's psychology: use it to compare, never to plan.",
    decimals=0,
)


def of_values(values: Mapping[str, float]) -> float:
    """Return the effort divided by 18."""
    return values[halstead_effort.QUANTITY.key] / STROUD
