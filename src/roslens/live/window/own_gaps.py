"""How long a tap may be silent by what it loses itself, though what it listens to goes on."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.live.window.bucket import Bucket

TIMES = 3.0
"""A silence shows something once it is so many times the longest gap that losses of the tap left lately."""
KEPT_S = 60.0
"""For how long such a gap is remembered."""
LARGE_BYTES = 65_000
"""Larger messages travel in parts, of which one that is lost loses the whole."""
LARGE_GAP_S = 2.0
"""The gap that a tap is taken to have made itself where messages are large, before any is known."""


class OwnGaps:
    """Remembers the longest gap in which a tap lost messages itself."""

    __slots__ = ("_gap", "_until")

    def __init__(self) -> None:
        self._gap = self._until = 0.0

    def clear(self) -> None:
        """Forget it."""
        self._gap = self._until = 0.0

    def doubted(self, buckets: Iterable[Bucket], horizon: float) -> float:
        """Return the seconds of silence which the tap may have made itself; times are on the observer's clock."""
        if horizon - self._until > KEPT_S:
            self._gap = 0.0
        for bucket in buckets:
            gap = bucket.gap if bucket.lost > 0 else 0.0
            if bucket.count and bucket.bytes > LARGE_BYTES * bucket.count:
                gap = max(gap, LARGE_GAP_S)
            if 0 < self._gap <= gap or gap > self._gap:
                self._gap, self._until = gap, bucket.end
        return TIMES * self._gap
