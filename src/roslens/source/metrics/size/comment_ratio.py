"""Comment lines for each line of code."""

from __future__ import annotations

import re
from collections.abc import Mapping

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.metrics.size import comment_lines, loc

QUANTITY = Quantity(
    key="comment_ratio",
    title="Comment ratio",
    unit="%",
    kinds=(EntityKind.FILE, EntityKind.PACKAGE),
    text="Comment lines for every hundred lines of code.",
    better=Better.HIGHER,
    formula="100 * comment_lines / loc",
    source="Santos et al., A Framework for Quality Assessment of ROS Repositories, IROS 2016 (%Com = LOCom / LOC, "
    "there as a ratio); thresholds of the ROS, NASA SATC, HIS and Akureyri models are in per cent",
    limits="Above 100 where there is more comment than code. HIS divides by statements, others by all lines: their "
    "values differ by the layout of the code. Absent where there is no code. A value that is too low in "
    "a ``setup.py`` or ``.cfg`` of dynamic_reconfigure is a note.",
    decimals=1,
)


_TABLES = re.compile(r"(?:.*/)?(?:setup\.py|[^/]+\.cfg)")


def speaks_for_itself(path: str) -> bool:
    """Return whether a file is a self-describing table: parameters for dynamic_reconfigure, a ``setup.py``."""
    return _TABLES.fullmatch(path) is not None


def of_values(values: Mapping[str, float]) -> float | None:
    """Return the ratio in per cent for a file or package, None where there is no code."""
    code = values.get(loc.QUANTITY.key)
    if not code:
        return None
    return 100.0 * values[comment_lines.QUANTITY.key] / code
