"""Lines added and deleted."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.history.touched import Touched

QUANTITY = Quantity(
    key="churn",
    title="Churn",
    unit="lines",
    kinds=(EntityKind.REPOSITORY, EntityKind.PACKAGE, EntityKind.FILE),
    text="How many lines were added and deleted in all its commits.",
    better=Better.NEITHER,
    formula="lines added + lines deleted, over all commits except merges",
    source="Nagappan and Ball, Use of Relative Code Churn Measures to Predict System Defect Density, ICSE 2005",
    limits="A line that changed counts twice; binary files count none. For a renamed file, only changed lines count; "
    "for its package and the repository, all its lines count twice. A clone without the contents of past files "
    "(`--filter=blob:none`) has no churn.",
)

COMMANDS = {
    "repository": "git log --no-merges --no-renames --numstat --format= HEAD | awk '{n += $1 + $2} END {print n}'",
    "file": "git log --follow --topo-order --no-merges --numstat --format= HEAD -- PATH "
    "| awk '{n += $1 + $2} END {print n}'",
    "path": "git log --no-merges --full-history --no-renames --numstat --format= HEAD -- PATH "
    "| awk '{n += $1 + $2} END {print n}'",
}
NEEDS_LINES = True


def of_touched(touched: Touched) -> float:
    """Return the number of lines."""
    return sum(change.added + change.deleted for _, changes in touched.commits for change in changes)
