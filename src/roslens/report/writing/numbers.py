"""How numbers are written for programs to read."""

from __future__ import annotations

import math

_EXACT = 2**53


def plain(value: float) -> float:
    """Return a whole number as an integer, so that 3 is written ``3`` and not ``3.0``."""
    if isinstance(value, float) and value.is_integer() and abs(value) <= _EXACT:
        return int(value)
    return value


def written(value: float | None) -> str:
    """Return the value as JSON and CSV have it; what is no finite number is empty."""
    if value is None or not math.isfinite(value):
        return ""
    return repr(plain(value))
