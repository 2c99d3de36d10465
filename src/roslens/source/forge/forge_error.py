"""Failures of requests to a forge."""

from __future__ import annotations


class ForgeError(Exception):
    """A forge that did not answer, or not by its interface.

    Attributes:
        what: was found, in one line.
        advice: what to do next.
    """

    def __init__(self, what: str, advice: str = "") -> None:
        """Take both."""
        super().__init__(what)
        self.what = what
        self.advice = advice
