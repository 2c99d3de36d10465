"""How far source is evaluated."""

from __future__ import annotations

MOST_STEPS = 150_000
"""Statements and expressions of one evaluation."""
MOST_OF_PLUGIN = 15_000
"""Further ones for each plug-in that is followed."""
MOST_DEPTH = 14
"""Calls in each other."""


class SpentError(Exception):
    """The bounds of evaluation are spent."""
