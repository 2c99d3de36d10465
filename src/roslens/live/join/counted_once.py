"""Who tells what was counted at a place, so that two who read the same counters do not tell everything twice."""

from __future__ import annotations

GIVEN_UP_S = 10.0
"""A place of which its teller said nothing for so long is anybody's again."""
MONITOR = "/monitor"
"""Ends the name of who speaks for the observers beside the monitor: their places are theirs."""


class CountedOnce:
    """Gives each place to the first who tells of it."""

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
