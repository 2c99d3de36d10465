"""Time since the last commit."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.history.touched import DAY_S, Touched

QUANTITY = Quantity(
    key="time_since_last_commit",
    title="Time since the last commit",
    unit="d",
    kinds=(EntityKind.REPOSITORY, EntityKind.PACKAGE, EntityKind.FILE),
    text="How many days before the head it was last changed.",
    better=Better.NEITHER,
    formula="(date of the head - latest date of a commit that counts) / 86400 s, at least 0; with `process.as_of` that "
    "time instead of the head's",
    source="plain difference of committer dates",
    limits="A repository has it only with `process.as_of`, because its head is its last commit.",
    decimals=1,
)

COMMANDS = {
    "file": "echo $((($(git log -1 --format=%ct HEAD) - $(git log --follow --topo-order --no-merges --format=%ct HEAD "
    "-- PATH | sort -n | tail -1)) / 86400))",
    "path": "echo $((($(git log -1 --format=%ct HEAD) - $(git log --no-merges --full-history --format=%ct HEAD -- PATH "
    "| sort -n | tail -1)) / 86400))",
}


def of_touched(touched: Touched) -> float | None:
    """Return days; None without commits, and for a repository that is looked at as of its own head."""
    if not touched.times or (touched.kind is EntityKind.REPOSITORY and touched.as_of_s == touched.head_s):
        return None
    return max(0.0, touched.as_of_s - max(touched.times)) / DAY_S
