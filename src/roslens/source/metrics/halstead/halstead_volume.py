"""Halstead's volume."""

from __future__ import annotations

from math import log2

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.syntax.facts import Halstead

QUANTITY = Quantity(
    key="halstead_volume",
    title="Halstead volume",
    unit="bits",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="How many bits are needed to encode the source with the shortest code for each token.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="V = N * log2(n), with the length N and the vocabulary n; 0 without tokens",
    source="Halstead, Elements of Software Science, 1977; the bound 8000 for a file is Verifysoft's",
    limits="See halstead_length for what is an operator. The volume of a file is not the sum over its functions: "
    "names are shared, and code outside functions is included.",
    decimals=1,
)


def of_halstead(counts: Halstead) -> float:
    """Return N * log2(n)."""
    vocabulary = counts.distinct_operators + counts.distinct_operands
    if not vocabulary:
        return 0
    return (counts.operators + counts.operands) * log2(vocabulary)
