"""Halstead's program length."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.source.syntax.facts import Halstead

QUANTITY = Quantity(
    key="halstead_length",
    title="Halstead length",
    unit="tokens",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="How many operators and operands there are.",
    folds=(Fold.SUM,),
    better=Better.NEITHER,
    formula="N = N1 + N2, all operators plus all operands. Operands are names, numbers, strings and characters, in "
    "C++ also the words of built-in types, this, true and their like, and an #include with its target; operators are "
    "all other keywords and all marks, with a pair of brackets as one",
    source="Halstead, Elements of Software Science, 1977",
    limits="Which token is an operator is a convention that differs from tool to tool: compare values of one tool "
    "only. Comments and docstrings are neither.",
)


def of_halstead(counts: Halstead) -> float:
    """Return N1 + N2."""
    return counts.operators + counts.operands
