"""Progress of a process that reads for another one, which shows it."""

from __future__ import annotations

from roslens.source.engines.watched_reader import Heard
from roslens.source.progress import Progress


class ToldProgress:
    """Tells steps and items to the process that asked."""

    def __init__(self, tell: Heard) -> None:
        """``tell`` has them heard there, by :func:`heard_by`."""
        self._tell = tell

    def step(self, title: str, total: int) -> None:
        """Tell that a step begins."""
        self._tell(True, title, total)

    def advance(self, count: int = 1, item: str = "") -> None:
        """Tell that ``count`` more items are done."""
        self._tell(False, item, count)

    def finish(self) -> None:
        """Do nothing: who shows it knows when all is done."""


def heard_by(progress: Progress) -> Heard:
    """Return what has progress shown of which another process tells."""

    def heard(begins: bool, text: str, count: int) -> None:
        if begins:
            progress.step(text, count)
        else:
            progress.advance(count, text)

    return heard
