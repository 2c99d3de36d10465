"""How running commands of CMake ends before its time."""

from __future__ import annotations

WAYS_OUT = ("", "continue", "break", "return")
"""How what runs is left before its end: of a round, a loop, a function or file."""


class ReturnedError(Exception):
    """``return()``, ``break()`` or ``continue()``, by ``what``; or ``stop``: configuration would fail here."""

    def __init__(self, what: str) -> None:
        super().__init__(what)
        self.what = what


class ExhaustedError(Exception):
    """Evaluation has taken too much; the text says of what."""
