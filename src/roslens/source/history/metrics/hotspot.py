"""Churn times complexity."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity

QUANTITY = Quantity(
    key="hotspot",
    title="Hotspot",
    unit="",
    kinds=(EntityKind.FILE,),
    text="Where changes are frequent and difficult: a file that changes often and is complex. Files with the highest "
    "values are worth reviewing first; the number itself has no meaning.",
    formula="`churn` of the file x sum of the cyclomatic complexity of its functions",
    source="Tornhill, Your Code as a Crime Scene, 2015, chapter 3 (change frequency and complexity)",
    limits="Grows with the size and age of a file. A file without functions has none.",
)

COMMANDS = {"file": "the command of `churn`, times the file's complexity as `roslens check` measures it"}


def of_file(churn: float, complexity: float | None) -> float | None:
    """Return the product.

    Args:
        churn: lines of the file that were added and deleted.
        complexity: of all its functions together; None where it has none.
    """
    return None if complexity is None else churn * complexity
