"""Share of duplicated lines."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity
from roslens.source.metrics.size import duplicated_lines, loc

QUANTITY = Quantity(
    key="duplication_ratio",
    title="Duplication",
    unit="%",
    kinds=(EntityKind.FILE, EntityKind.PACKAGE),
    text="How many of a hundred lines of code are copies or have one in the same package.",
    formula="100 * duplicated_lines / loc",
    source="duplicated lines (%) of SonarQube, with code lines on both sides",
    limits="As duplicated_lines. Absent where there is no code.",
    maximum=100,
    decimals=1,
)


def of_values(values: Mapping[str, float]) -> float | None:
    """Return the share in per cent for a file or package, None where there is no code."""
    code = values.get(loc.QUANTITY.key)
    lines = values.get(duplicated_lines.QUANTITY.key)
    if not code or lines is None:
        return None
    return 100.0 * lines / code
