"""Halstead's estimate of delivered bugs."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.halstead import halstead_volume

BITS_FOR_A_BUG = 3000
"""The volume that Halstead's data show to hold one error."""

QUANTITY = Quantity(
    key="halstead_bugs",
    title="Halstead bugs",
    unit="bugs",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="How many errors code of this volume is expected to be delivered with.",
    folds=(Fold.SUM, Fold.MAX),
    formula="B = V / 3000",
    source="Halstead, Elements of Software Science, 1977 (his other form is E^(2/3) / 3000); the bound 2 for a file "
    "is Verifysoft's",
    limits="It is volume in another unit. The sum of a package is over files.",
    decimals=2,
)


def of_values(values: Mapping[str, float]) -> float:
    """Return the volume divided by 3000."""
    return values[halstead_volume.QUANTITY.key] / BITS_FOR_A_BUG
