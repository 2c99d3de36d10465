"""How far source is evaluated, and what one evaluation has used of it."""

from __future__ import annotations

MOST_STEPS = 150_000
"""Statements and expressions of one evaluation."""
MOST_OF_PLUGIN = 15_000
"""Further ones for each plug-in that is followed."""
MOST_DEPTH = 14
"""Calls in each other."""


class SpentError(Exception):
    """The bounds of evaluation are spent."""


class Budget:
    """What one evaluation may still do.

    Attributes:
        steps: statements and expressions that were evaluated so far.
        most: of them that may be.
    """

    __slots__ = ("most", "steps")

    def __init__(self, most: int = MOST_STEPS) -> None:
        """Begin with nothing spent."""
        self.steps, self.most = 0, most

    def spend(self) -> None:
        """Count a statement or an expression.

        Raises:
            SpentError: there were too many.
        """
        self.steps += 1
        if self.steps > self.most:
            raise SpentError

    def extend(self) -> None:
        """Let a plug-in that is followed take steps of its own."""
        self.most += MOST_OF_PLUGIN
