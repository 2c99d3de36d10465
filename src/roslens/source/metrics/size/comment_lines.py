"""Comment lines."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.source.syntax.facts import Lines

QUANTITY = Quantity(
    key="comment_lines",
    title="Comment lines",
    unit="lines",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="Lines that contain nothing but comments.",
    folds=(Fold.SUM,),
    better=Better.NEITHER,
    formula="number of lines with comment but no code; Python docstrings are comment",
    source="cloc (Daniel, github.com/AlDanial/cloc), whose `comment` it equals",
    limits="Code that is commented out, licence headers and rulers count as comment. A comment behind code does not. "
    "A comment above a function belongs to its file, not to the function.",
)


def of_lines(lines: Lines) -> float:
    """Return the number of comment lines of a function or file."""
    return lines.comment
