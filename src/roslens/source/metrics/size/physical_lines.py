"""Physical lines."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.source.syntax.facts import Lines

QUANTITY = Quantity(
    key="physical_lines",
    title="Physical lines",
    unit="lines",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE),
    text="All lines, whatever is on them.",
    folds=(Fold.SUM, Fold.MAX),
    better=Better.NEITHER,
    formula="code lines + comment lines + blank lines; of a function from the line of its first token to that of its "
    "closing brace (C, C++) or of its last statement (Python)",
    source="cloc (Daniel, github.com/AlDanial/cloc)",
    limits="A last line without a line break counts as a line.",
)


def of_lines(lines: Lines) -> float:
    """Return the number of lines of a function or file."""
    return lines.physical
