"""Whether an observer was there all the time: who was stopped reads late what came meanwhile, or lost it."""

from __future__ import annotations

PAUSE_S = 0.6
"""Between two turns of an observer that was there."""
SETTLE_S = 0.4
"""After a pause, queued data is read for this long; its arrival is no evidence of when it was sent."""


class Attention:
    """Notes the turns of an observer; times are of a clock that never jumps."""

    def __init__(self, now: float, pause_s: float = PAUSE_S) -> None:
        """Begin at ``now``; turns that are further apart than ``pause_s`` are a pause."""
        self._pause_s = pause_s
        self._turned = now
        self._settled = float("-inf")

    def turn(self, now: float) -> bool:
        """Note a turn; return whether what is seen now was seen when it came."""
        if now - self._turned > self._pause_s:
            self._settled = now + SETTLE_S
        self._turned = now
        return now >= self._settled

    def there(self, now: float) -> bool:
        """Return the same between two turns."""
        return now - self._turned <= self._pause_s and now >= self._settled
