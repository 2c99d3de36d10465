"""Share of who contributed most."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.history.touched import Touched

QUANTITY = Quantity(
    key="ownership",
    title="Ownership",
    unit="",
    kinds=(EntityKind.REPOSITORY, EntityKind.PACKAGE, EntityKind.FILE),
    text="Share of the contributions that were made by the most active contributor.",
    better=Better.NEITHER,
    formula="contributions of the person with most / contributions of all; a commit is one contribution of its author "
    "and of each co-author",
    source="Bird et al., Don't Touch My Code! Examining the Effects of Ownership on Software Quality, FSE 2011",
    limits="A file with one commit has an owner of 1. Contributions are commits, whatever their size.",
    maximum=1,
    decimals=2,
)

COMMANDS = {
    "repository": "git shortlog -sn --group=author --group=trailer:co-authored-by HEAD "
    "| awk 'NR == 1 {m = $1} {t += $1} END {print m / t}'",
    "file": "git shortlog -sn --no-walk --group=author --group=trailer:co-authored-by "
    "$(git log --follow --topo-order --no-merges --format=%H HEAD -- PATH) "
    "| awk 'NR == 1 {m = $1} {t += $1} END {print m / t}'",
    "path": "git shortlog -sn --no-merges --full-history --group=author --group=trailer:co-authored-by HEAD -- PATH "
    "| awk 'NR == 1 {m = $1} {t += $1} END {print m / t}'",
}


def of_touched(touched: Touched) -> float | None:
    """Return the share; None without commits."""
    return touched.shares[0] / sum(touched.shares) if touched.shares else None
