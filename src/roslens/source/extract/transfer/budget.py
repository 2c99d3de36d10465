"""How far source is evaluated, and what one evaluation has used of it."""

from __future__ import annotations

MOST_STEPS = 150_000
"""Statements and expressions of one evaluation."""
MOST_OF_PLUGIN = 15_000
"""Further ones for each plug-in that is followed."""
MOST_DEPTH = 14
"""Calls in each other."""
MOST_TURNS = 64
"""Of a loop over a list."""


class BudgetExceededError(Exception):
    """The bounds of evaluation are spent."""


class Budget:
    """What one evaluation may still do.

    Attributes:
        depth: calls that may be in each other.
        turns: of a loop over a list that are followed one by one.
        repeats: turns of a loop with a condition that are followed as long as it is known to hold; 0 follows one turn
            that stands for all.
        steps: statements and expressions that were evaluated so far.
        most: of them that may be.
    """

    __slots__ = ("depth", "most", "repeats", "steps", "turns")

    def __init__(
        self, most: int = MOST_STEPS, depth: int = MOST_DEPTH, turns: int = MOST_TURNS, repeats: int = 0
    ) -> None:
        """Begin with nothing spent."""
        self.steps, self.most = 0, most
        self.depth, self.turns, self.repeats = depth, turns, repeats

    def spend(self) -> None:
        """Count a statement or an expression.

        Raises:
            BudgetExceededError: there were too many.
        """
        self.steps += 1
        if self.steps > self.most:
            raise BudgetExceededError

    def extend(self) -> None:
        """Let a plug-in that is followed take steps of its own."""
        self.most += MOST_OF_PLUGIN
