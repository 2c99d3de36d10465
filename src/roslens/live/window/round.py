"""The time between two ticks of a monitor: what came in it is noticed at its end."""

from __future__ import annotations


class Round:
    """One such time; all connections share it, so that a tick notes only once when all of them were noticed.

    Attributes:
        time: of the tick that ends it; None while it goes on.
    """

    __slots__ = ("time",)

    def __init__(self) -> None:
        self.time: float | None = None
