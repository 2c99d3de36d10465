"""Number of revisions (#Rev)."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.history.touched import Touched

QUANTITY = Quantity(
    key="revisions",
    title="Revisions",
    unit="commits",
    kinds=(EntityKind.REPOSITORY, EntityKind.PACKAGE, EntityKind.FILE),
    text="How often it was changed: the commits behind the head.",
    better=Better.NEITHER,
    formula="number of commits; of a package or file those that change it and are not merges",
    source="Santos et al., A Framework for Quality Assessment of ROS Repositories, IROS 2016 (#Rev)",
    limits="A package that came from another repository begins there. A history that was squashed has few.",
)

COMMANDS = {
    "repository": "git rev-list --count HEAD",
    "file": "git log --follow --topo-order --no-merges --format=%H HEAD -- PATH | wc -l",
    "path": "git rev-list --count --no-merges --full-history HEAD -- PATH",
}


def of_touched(touched: Touched) -> float:
    """Return the number of commits."""
    return len(touched.commits)
