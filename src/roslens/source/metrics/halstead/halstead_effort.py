"""Halstead's effort."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.halstead import halstead_difficulty, halstead_volume

QUANTITY = Quantity(
    key="halstead_effort",
    title="Halstead effort",
    unit="discriminations",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="How many elementary decisions of the mind it takes to write the code.",
    folds=(Fold.SUM, Fold.MAX),
    formula="E = D * V",
    source="Halstead, Elements of Software Science, 1977",
    limits="See halstead_length for what is an operator. Treat it as a ranking, not as a duration.",
    decimals=0,
)


def of_values(values: Mapping[str, float]) -> float:
    """Return difficulty times volume."""
    return values[halstead_difficulty.QUANTITY.key] * values[halstead_volume.QUANTITY.key]
