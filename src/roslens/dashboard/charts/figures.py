"""Numbers as readers want them: grouped, with as many digits as the quantity deserves."""

from __future__ import annotations

import math

NOT_MEASURED = "\N{EN DASH}"


def number(value: float | None, decimals: int = 0) -> str:
    """Return ``12,345.6``; a dash where there is no value; no decimals that are all zero by nature."""
    if value is None:
        return NOT_MEASURED
    if not math.isfinite(value):
        return str(value)
    if decimals == 0 and value != int(value):
        decimals = 1 if abs(value) >= 1 else 2
    return f"{value:,.{decimals}f}"


def compact(value: float) -> str:
    """Return at most four significant digits without trailing zeros, for scripts and axes."""
    if value == int(value) and abs(value) < 1e6:
        return str(int(value))
    return f"{value:.4g}"


def share(part: float, whole: float) -> str:
    """Return a percentage; ``< 1 %`` rather than a false zero."""
    if not whole:
        return NOT_MEASURED
    percent = 100 * part / whole
    if 0 < percent < 1:
        return "< 1 %"
    if 99 < percent < 100:
        return "> 99 %"
    return f"{percent:.0f} %"
