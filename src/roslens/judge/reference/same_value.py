"""When a value that is reported as text is the one that is expected."""

from __future__ import annotations


def number_of(text: str) -> float | None:
    """Return the number that a text is; None where it is none, or not finite."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if value - value == 0 else None


def same_value(value: str, expected: str) -> bool:
    """Return whether two texts are the same, or the same number: ``5`` is ``5.0``, ``true`` is not ``1``."""
    mine, theirs = number_of(value), number_of(expected)
    return value.strip() == expected.strip() or (mine is not None and mine == theirs)
