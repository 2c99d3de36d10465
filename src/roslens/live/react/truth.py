"""Three-valued logic, after Kleene (1938), strong: None is unknown."""

from __future__ import annotations

from collections.abc import Iterable

Truth = bool | None


def all_of(parts: Iterable[Truth]) -> Truth:
    """Return whether all are true: false where one is false, else unknown where one is."""
    found = list(parts)
    return False if False in found else None if None in found else True


def any_of(parts: Iterable[Truth]) -> Truth:
    """Return whether one is true: true where one is, else unknown where one is unknown."""
    found = list(parts)
    return True if True in found else None if None in found else False


def at_least(count: int, parts: Iterable[Truth]) -> Truth:
    """Return whether ``count`` are true, unknown where those that are unknown decide it."""
    found = list(parts)
    sure = found.count(True)
    if sure >= count:
        return True
    return None if sure + found.count(None) >= count else False


def negated(part: Truth) -> Truth:
    """Return the opposite; that of unknown is unknown."""
    return None if part is None else not part
