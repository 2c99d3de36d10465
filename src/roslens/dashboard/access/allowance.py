"""Rate limits: a token bucket for each address."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable

MOST_PEERS = 1024
"""Addresses that are remembered; of more, who came longest ago is forgotten."""


class Allowance:
    """Lets each peer do something ``most`` times at once, and then once in ``each_s`` seconds."""

    def __init__(self, most: int, each_s: float, clock: Callable[[], float]) -> None:
        """``clock`` gives seconds that only grow."""
        self._most = float(most)
        self._each_s = each_s
        self._clock = clock
        self._left: OrderedDict[str, tuple[float, float]] = OrderedDict()

    def take(self, peer: str) -> float:
        """Take one; return 0, or where there is none left, for how many seconds to wait."""
        now = self._clock()
        left = self._of(peer, now)
        if left < 1.0:
            return (1.0 - left) * self._each_s
        self._left[peer] = (left - 1.0, now)
        self._left.move_to_end(peer)
        while len(self._left) > MOST_PEERS:
            self._left.popitem(last=False)
        return 0.0

    def wait(self, peer: str) -> float:
        """Return for how many seconds there is nothing to take, without taking any."""
        left = self._of(peer, self._clock())
        return 0.0 if left >= 1.0 else (1.0 - left) * self._each_s

    def _of(self, peer: str, now: float) -> float:
        left, at = self._left.get(peer, (self._most, now))
        return min(self._most, left + (now - at) / self._each_s)
