"""Blank lines."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.source.syntax.facts import Lines

QUANTITY = Quantity(
    key="blank_lines",
    title="Blank lines",
    unit="lines",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="Lines that contain nothing but white space.",
    folds=(Fold.SUM,),
    better=Better.NEITHER,
    formula="number of lines without a visible character",
    source="cloc (Daniel, github.com/AlDanial/cloc), whose `blank` it equals",
    limits="As cloc does it, a blank line inside a block comment is blank, not comment.",
)


def of_lines(lines: Lines) -> float:
    """Return the number of blank lines of a function or file."""
    return lines.blank
