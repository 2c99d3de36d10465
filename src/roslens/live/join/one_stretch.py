"""One stretch after the other for each connection, however many identifiers its publisher has.

A node that was started again, or that publishes twice on a topic, is counted by identifier. Of one connection that
makes several tallies about the same time, and silent ones at times of their own; a window takes one after the other.
"""

from __future__ import annotations

from collections.abc import Container, Iterable

import msgspec

from roslens.live.inside.counters import merged, superposed
from roslens.live.window.newest import keep_newest
from roslens.model.traffic.tally import Tally

_STEP_S = 5.0
"""What ends so long before the last is of a clock that was set back."""
MOST = 20_000

_Key = tuple[str, str, str, str]


class OneStretch:
    """Joins the tallies of one read, and cuts off what was reported before.

    Attributes:
        several: node and topic of publishers that are there more than once under one name.
    """

    def __init__(self) -> None:
        self._until: dict[_Key, float] = {}
        self.several: Container[tuple[str, str]] = ()

    def of(self, tallies: Iterable[Tally]) -> list[Tally]:
        """Return at most one tally for each connection, none about a time that an earlier one was about."""
        groups: dict[_Key, list[Tally]] = {}
        for given in tallies:
            tally = superposed(given) if (given.publisher, given.topic) in self.several else given
            groups.setdefault((tally.topic, tally.publisher, tally.subscriber, tally.host), []).append(tally)
        if len(self._until) > MOST:
            keep_newest(self._until, MOST // 2)
        found = []
        for key, group in groups.items():
            whole = group[0]
            for other in group[1:]:
                whole = merged(whole, other)
            until = self._until.pop(key, float("-inf"))
            if whole.end < until - _STEP_S:
                until = float("-inf")
            self._until[key] = max(whole.end, until)
            if whole.end <= until and not whole.count:
                continue
            if whole.start < until:
                whole = msgspec.structs.replace(whole, start=min(until, whole.end))
            found.append(whole)
        return found
