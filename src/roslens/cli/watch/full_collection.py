"""When the collector of garbage goes through everything that a monitor keeps: now and then, not in every few snapshots.

By itself it does so whenever a quarter more was made and lived for a while. With a large system that is every ten
seconds, takes a fifth of one each time, and finds next to nothing: what a monitor drops is in no cycles, or young.
"""

from __future__ import annotations

import gc
from collections.abc import Callable

EVERY_S = 60.0
_YOUNG = 20_000
_MIDDLE = 10
_NEVER = 1_000_000_000


class FullCollection:
    """Takes the place of the collector's own rule for the whole process, from the first call on."""

    def __init__(self, steady: Callable[[], float], collect: Callable[[], object] = gc.collect) -> None:
        """Begin.

        Args:
            steady: a monotonic clock, in seconds.
            collect: goes through everything.
        """
        self._steady = steady
        self._collect = collect
        self._due = steady() + EVERY_S
        gc.set_threshold(_YOUNG, _MIDDLE, _NEVER)

    def now_and_then(self) -> None:
        """Go through everything, where that is due."""
        if self._steady() < self._due:
            return
        self._collect()
        self._due = self._steady() + EVERY_S
