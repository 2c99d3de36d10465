"""Number of contributors (#DC)."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.history.touched import Touched

QUANTITY = Quantity(
    key="contributors",
    title="Contributors",
    unit="people",
    kinds=(EntityKind.REPOSITORY, EntityKind.PACKAGE, EntityKind.FILE),
    text="How many people have worked on it: authors of commits, and co-authors that commits name.",
    better=Better.NEITHER,
    formula="number of distinct names of authors and of `Co-authored-by:` trailers, after `.mailmap`",
    source="Santos et al., A Framework for Quality Assessment of ROS Repositories, IROS 2016 (#DC, typed in by hand "
    "there)",
    limits="A person with two names counts twice unless `.mailmap` joins them; programs that commit count as people. "
    "Names are compared but not stored.",
)

COMMANDS = {
    "repository": "git shortlog -s --group=author --group=trailer:co-authored-by HEAD | wc -l",
    "file": "git shortlog -s --no-walk --group=author --group=trailer:co-authored-by "
    "$(git log --follow --topo-order --no-merges --format=%H HEAD -- PATH) | wc -l",
    "path": "git shortlog -s --no-merges --full-history --group=author --group=trailer:co-authored-by HEAD -- PATH "
    "| wc -l",
}


def of_touched(touched: Touched) -> float:
    """Return the number of people."""
    return len(touched.shares)
