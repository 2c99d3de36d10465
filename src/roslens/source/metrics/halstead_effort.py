"""Halstead's effort."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics import halstead_difficulty, halstead_volume
from roslens.source.syntax.facts import Halstead

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


def of_halstead(counts: Halstead) -> float:
    """Return difficulty times volume."""
    return halstead_difficulty.of_halstead(counts) * halstead_volume.of_halstead(counts)
