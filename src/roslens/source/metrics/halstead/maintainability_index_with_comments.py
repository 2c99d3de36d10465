"""Maintainability index with the comment term."""

from __future__ import annotations

from collections.abc import Mapping
from math import sin, sqrt

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.source.metrics.halstead import maintainability_index

QUANTITY = Quantity(
    key="maintainability_index_with_comments",
    title="Maintainability index with comments",
    unit="",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE, EntityKind.PACKAGE),
    text="The maintainability index with a reward for comments.",
    better=Better.HIGHER,
    formula="(171 - 5.2 ln V - 0.23 CC - 16.2 ln LOC + 50 sin(sqrt(2.4 * C))) * 100 / 171, at least 0 and at most "
    "100, with C = comment_lines / (comment_lines + loc) and the rest as in maintainability_index",
    source="Oman and Hagemeister as revised by Welker, Oman and Atkinson, Development and Application of an "
    "Automated Source Code Maintainability Index, J. Software Maintenance 9(3), 1997",
    limits="Whether C is a ratio or a percentage is disputed; as a ratio the term grows with the comments up to its "
    "50, as a percentage it swings up and down (radon takes the percentage in radians, the 2016 paper comments "
    "divided by code). Absent where there is no code.",
    maximum=100,
    decimals=1,
)


def of_values(values: Mapping[str, float]) -> float | None:
    """Return the index from the other values of a function, file or package."""
    comment = values.get("comment_lines")
    if not comment:
        # Most functions have no comment, and their index stands there already.
        index = values.get(maintainability_index.QUANTITY.key)
        return maintainability_index.of_values(values) if index is None else index
    value = maintainability_index.unscaled(values)
    if value is None:
        return None
    return maintainability_index.scaled(value + 50 * sin(sqrt(2.4 * comment / (comment + values["loc"]))))
