"""Waits for all observers at once, so that none is read late because another one has nothing to send.

An agent that asks for the time learns the offset of its clock as exactly as its question is answered at once.
"""

from __future__ import annotations

import select
import time
from collections.abc import Iterable, Sequence
from typing import Protocol, cast

SHORTEST_S = 0.005
"""Between two looks at the system, however much comes."""


class _Waitable(Protocol):
    def descriptors(self) -> Iterable[int]: ...


class Waiting:
    """What a set of sources waits for; sources without descriptors wait themselves, in turn."""

    def __init__(self, sources: Sequence[object], longest_s: float) -> None:
        """Wait at most ``longest_s`` seconds at a time."""
        self._waitable = [cast("_Waitable", source) for source in sources if hasattr(source, "descriptors")]
        self._others = len(sources) - len(self._waitable)
        self._longest_s = longest_s
        self._ended = 0.0

    def wait(self) -> float:
        """Wait until one of them has something; return how long each has to wait in its own ``poll``."""
        if self._others or not self._waitable:
            return self._longest_s / max(self._others + len(self._waitable), 1)
        early = SHORTEST_S - (time.monotonic() - self._ended)
        if early > 0:
            time.sleep(early)
        found = [one for source in self._waitable for one in source.descriptors()]
        select.select(found, [], [], self._longest_s)
        self._ended = time.monotonic()
        return 0.0
