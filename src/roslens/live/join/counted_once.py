"""Which observer reports the counters of a place, so that two that read the same counters do not both report them."""

from __future__ import annotations

GIVEN_UP_S = 10.0
"""A place that its observer has not reported for this long may be reported by another again."""
MONITOR = "/monitor"
"""Ends the name of who speaks for the observers beside the monitor: their places are theirs."""


class CountedOnce:
    """Assigns each place to the first observer that reports it."""

    def __init__(self) -> None:
        self._tellers: dict[str, tuple[str, float]] = {}

    def accepts(self, place: str, sender: str, now: float) -> bool:
        """Return whether it is ``sender`` whose word about a place is taken at ``now``."""
        if not place:
            return True
        teller, last_report = self._tellers.get(place, ("", now))
        free = not teller or not 0 <= now - last_report < GIVEN_UP_S
        if free or teller == sender or (sender.endswith(MONITOR) and not teller.endswith(MONITOR)):
            self._tellers[place] = (sender, now)
            return True
        return False
