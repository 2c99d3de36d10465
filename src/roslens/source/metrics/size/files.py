"""Number of source files."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.model.source import SourceFile

QUANTITY = Quantity(
    key="files",
    title="Source files",
    unit="files",
    kinds=(EntityKind.PACKAGE,),
    text="How many source files of its own the package has.",
    better=Better.NEITHER,
    formula="number of files of C, C++ and Python (launch.py included) in the role own",
    source="plain count",
    limits="Tests and what is generated or vendored are left out, as in every value of a package.",
)


def of_files(files: Sequence[SourceFile]) -> float:
    """Return the number of source files."""
    return len(files)
