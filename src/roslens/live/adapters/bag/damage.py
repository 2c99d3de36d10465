"""Parts of a recording that cannot be read, and the list of what was reported of them."""

from __future__ import annotations

from pathlib import Path

from roslens.model.failure import Failure
from roslens.model.source import Location

MOST = 50


class DamageError(ValueError):
    """Bytes that are not as expected; the text states what was found."""


class FailureLog:
    """What could not be read of a recording: each thing once, and not more than a person would read."""

    def __init__(self) -> None:
        self._failures: dict[Failure, None] = {}
        self._left_out = 0

    def add(self, path: Path | str, what: str, *, expected: str = "", advice: str = "", partial: bool = True) -> None:
        """Note a failure of a file; one that was noted before counts once."""
        location = Location(str(path))
        failure = Failure("bag", what, expected, advice, location=location, partial=partial)
        if failure in self._failures:
            return
        if len(self._failures) >= MOST:
            self._left_out += 1
            return
        self._failures[failure] = None

    def extend(self, other: FailureLog) -> None:
        """Note all of another list."""
        for failure in other._failures:
            self._failures.setdefault(failure)
        self._left_out += other._left_out

    def all(self) -> tuple[Failure, ...]:
        """Return what was noted, in the order in which it was met."""
        found = tuple(self._failures)
        if self._left_out:
            found += (Failure("bag", f"{self._left_out} more failures of this kind, not listed", partial=True),)
        return found
