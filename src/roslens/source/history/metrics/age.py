"""Age since the first commit."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.history.touched import DAY_S, Touched

QUANTITY = Quantity(
    key="age",
    title="Age",
    unit="d",
    kinds=(EntityKind.REPOSITORY, EntityKind.PACKAGE, EntityKind.FILE),
    text="How many days have passed between its first commit and the head.",
    better=Better.NEITHER,
    formula="(date of the head - earliest date of a commit that counts) / 86400 s; with `process.as_of` that time "
    "instead of the head's",
    source="plain difference of committer dates",
    limits="Dates are those of the committers' clocks; commits that are dated before one of their parents are "
    "reported with the repository. Relative to the head's date, not today's, so that a commit always has one age.",
    decimals=1,
)

COMMANDS = {
    "repository": "echo $((($(git log -1 --format=%ct HEAD) - $(git log --format=%ct HEAD | sort -n | head -1)) / "
    "86400))",
    "file": "echo $((($(git log -1 --format=%ct HEAD) - $(git log --follow --topo-order --no-merges --format=%ct HEAD "
    "-- PATH | sort -n | head -1)) / 86400))",
    "path": "echo $((($(git log -1 --format=%ct HEAD) - $(git log --no-merges --full-history --format=%ct HEAD -- PATH "
    "| sort -n | head -1)) / 86400))",
}


def of_touched(touched: Touched) -> float | None:
    """Return days; None without commits."""
    return max(0.0, touched.as_of_s - min(touched.times)) / DAY_S if touched.times else None
