"""Halstead's difficulty."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.syntax.facts import Halstead

QUANTITY = Quantity(
    key="halstead_difficulty",
    title="Halstead difficulty",
    unit="",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="How error-prone the code is to write: it rises with the kinds of operators and with the use of each operand.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="D = (n1 / 2) * (N2 / n2); 0 without operands",
    source="Halstead, Elements of Software Science, 1977",
    limits="See halstead_length for what is an operator. HAROS 3 has n1 / (2 * N2 / n2), which falls where this rises.",
    decimals=1,
)


def of_halstead(counts: Halstead) -> float:
    """Return (n1 / 2) * (N2 / n2)."""
    if not counts.distinct_operands:
        return 0
    return (counts.distinct_operators / 2) * (counts.operands / counts.distinct_operands)
