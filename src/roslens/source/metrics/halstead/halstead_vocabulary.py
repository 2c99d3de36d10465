"""Halstead's vocabulary."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.source.syntax.facts import Halstead

QUANTITY = Quantity(
    key="halstead_vocabulary",
    title="Halstead vocabulary",
    unit="tokens",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="How many different operators and operands there are.",
    folds=(Fold.MEAN, Fold.MAX),
    better=Better.NEITHER,
    formula="n = n1 + n2, distinct operators plus distinct operands",
    source="Halstead, Elements of Software Science, 1977",
    limits="See halstead_length for what is an operator. Names are distinguished by spelling, not by what they mean.",
    decimals=1,
)


def of_halstead(counts: Halstead) -> float:
    """Return n1 + n2."""
    return counts.distinct_operators + counts.distinct_operands
