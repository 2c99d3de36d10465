"""How few people contributed half of the work."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.history.touched import Touched

QUANTITY = Quantity(
    key="bus_factor",
    title="Bus factor",
    unit="people",
    kinds=(EntityKind.REPOSITORY, EntityKind.PACKAGE),
    text="The smallest number of people who together made at least half of the contributions.",
    better=Better.HIGHER,
    formula="least n such that the n people with most contributions have at least half of all; contributions as in "
    "`ownership`",
    source="CHAOSS, Contributor Absence Factor (chaoss.community/kb/metric-contributor-absence-factor)",
    limits="Over the whole history: people who left years ago count. Contributions are commits, whatever their size.",
)

COMMANDS = {
    "repository": "git shortlog -sn --group=author --group=trailer:co-authored-by HEAD "
    "| awk '{n[NR] = $1; t += $1} END {while (2 * s < t) s += n[++i]; print i}'",
    "path": "git shortlog -sn --no-merges --full-history --group=author --group=trailer:co-authored-by HEAD -- PATH "
    "| awk '{n[NR] = $1; t += $1} END {while (2 * s < t) s += n[++i]; print i}'",
}


def of_touched(touched: Touched) -> float | None:
    """Return the number of people; None without commits."""
    total, seen = sum(touched.shares), 0
    for number, share in enumerate(touched.shares, 1):
        seen += share
        if 2 * seen >= total:
            return number
    return None
