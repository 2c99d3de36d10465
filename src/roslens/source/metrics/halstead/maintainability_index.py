"""Maintainability index."""

from __future__ import annotations

from collections.abc import Mapping
from math import log

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity

QUANTITY = Quantity(
    key="maintainability_index",
    title="Maintainability index",
    unit="",
    kinds=(EntityKind.FUNCTION, EntityKind.FILE, EntityKind.PACKAGE),
    text="How easy the code is to maintain, from 0 to 100: small, simple pieces of few tokens score high.",
    better=Better.HIGHER,
    formula="(171 - 5.2 ln V - 0.23 CC - 16.2 ln LOC) * 100 / 171, at least 0 and at most 100. V is halstead_volume, "
    "CC cyclomatic_complexity, LOC loc (V and LOC at least 1): of the function; of the file, with the mean CC of its "
    "functions (0 without any); of the package, with the means of V and LOC over its files and of CC over its "
    "functions",
    source="Oman and Hagemeister, Construction and Testing of Polynomials Predicting Software Maintainability, JSS "
    "24, 1994; scaled to 100 as Microsoft does (bound 20); the other bound, 65, is Verifysoft's",
    limits="Fitted to C and Pascal of 1992 and dominated by length. radon and HAROS 3 take the sum of CC over the "
    "file, so long files score lower there. Absent where there is no code.",
    maximum=100,
    decimals=1,
)


def unscaled(values: Mapping[str, float]) -> float | None:
    """Return 171 - 5.2 ln V - 0.23 CC - 16.2 ln LOC from the values of one entity, None where there is no code."""
    code = values.get("loc")
    if not code:
        return None
    code /= values.get("files", 1)
    volume = values["halstead_volume"]
    complexity = values.get("cyclomatic_complexity", 0.0)
    return 171 - 5.2 * (log(volume) if volume > 1 else 0) - 0.23 * complexity - 16.2 * (log(code) if code > 1 else 0)


def scaled(value: float) -> float:
    """Return ``value`` in hundredths of 171, between 0 and 100."""
    return min(100.0, max(0.0, value * 100 / 171))


def of_values(values: Mapping[str, float]) -> float | None:
    """Return the index from the other values of a function, file or package."""
    value = unscaled(values)
    return None if value is None else scaled(value)
