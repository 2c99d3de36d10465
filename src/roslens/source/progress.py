"""Progress of a long step."""

from __future__ import annotations

from typing import Protocol


class Progress(Protocol):
    """Receives steps as they begin and items as they are done."""

    def step(self, title: str, total: int) -> None:
        """Begin a step of ``total`` items (0: unknown)."""

    def advance(self, count: int = 1, item: str = "") -> None:
        """Report that ``count`` more items are done, the last of them ``item``."""


class Silent:
    """Progress is not shown."""

    def step(self, title: str, total: int) -> None:
        """Do nothing."""

    def advance(self, count: int = 1, item: str = "") -> None:
        """Do nothing."""
