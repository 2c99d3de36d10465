"""What a case of the gate returns."""

from __future__ import annotations

from collections.abc import Callable

from wrong_ok.scene import Scene

Case = Callable[[Scene], list[str]]
"""Runs a case; returns what was called ok though it was wrong, done though it does harm, or left undone."""


def unless(right: bool, mistake: str) -> list[str]:
    """Return a mistake, unless all is right."""
    return [] if right else [mistake]
