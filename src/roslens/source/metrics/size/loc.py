"""Lines of code."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.source.syntax.facts import Lines

QUANTITY = Quantity(
    key="loc",
    title="Lines of code",
    unit="lines",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="Lines that contain anything other than comments and white space.",
    folds=(Fold.SUM, Fold.MAX),
    better=Better.NEITHER,
    formula="number of lines with at least one character of code; a line with code and a comment is code; "
    "preprocessor lines are code; a docstring is a comment",
    source="cloc (Daniel, github.com/AlDanial/cloc), whose `code` it equals",
    limits="Lines follow the author's formatting: one statement over three lines is three lines of code. In a "
    "package the code of tests, and what is generated or vendored, is left out.",
)


def of_lines(lines: Lines) -> float:
    """Return the number of code lines of a function or file."""
    return lines.code
