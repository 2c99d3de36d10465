"""When what is published, and how much at once: everything each second, what changed at once; the clock is given."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Protocol, TypeVar

from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import Reference
from roslens.live.publish.diagnostics import diagnostics, journal_statuses
from roslens.live.publish.placed import Placed
from roslens.live.publish.rated import connection_statistics, ranges_of, rated_signals
from roslens.model.acting.outgoing import VERSION, Outgoing, RatedSignals
from roslens.model.entity import EntityId
from roslens.model.graph import Graph
from roslens.model.verdict import Verdict
from roslens.store.journals.journal_head import JournalHead

PERIOD_S = 1.0
SOONEST_S = 0.1
"""Changes that come sooner after others are gathered, so that a storm of them is few messages."""
MOST_AT_ONCE = 1000
"""Statuses, signals or connections in one message; more are reported in several."""
_One = TypeVar("_One")


class Watched(Protocol):
    """What is reported."""

    def standing(self) -> Sequence[Verdict]: ...  # noqa: D102
    def graph(self) -> Graph: ...  # noqa: D102
    def readings(self, now: float) -> Sequence[tuple[EntityId, dict[str, float]]]: ...  # noqa: D102


class Turns:
    """Makes the messages of one monitor.

    Args:
        watched: what to tell of.
        reference: returns what it is held against now.
        host: the name of the monitor's host.
        diagnostics: whether there are messages for /diagnostics.
        rated: whether there are messages of roslens_msgs.
        journals: returns where journals of the host end; they are told of each second.
    """

    def __init__(
        self, watched: Watched, reference: Callable[[], Reference], host: str, *, diagnostics: bool, rated: bool,
        journals: Callable[[], Iterable[JournalHead]] = tuple,
    ) -> None:  # fmt: skip
        self._watched = watched
        self._reference = reference
        self._ranges: dict[str, Range] = {}
        self._held: Reference | None = None
        self._host = host
        self._diagnostics = diagnostics
        self._rated = rated
        self._journals = journals
        self._changed: set[EntityId] = set()
        self._all_due = self._soonest = float("-inf")

    def take(self, changed: Iterable[Verdict], now: float) -> list[Outgoing]:
        """Return what is to be published at ``now``, seconds since the epoch, after these verdicts changed."""
        self._changed.update(one.entity for one in changed)
        if self._all_due - now > PERIOD_S:  # the clock was set back
            self._all_due = self._soonest = now
        if now >= self._all_due:
            self._all_due = max(self._all_due + PERIOD_S, now + PERIOD_S / 2)
            return self._reported(self._watched.standing(), now, complete=True)
        if self._changed and now >= self._soonest:
            changed_now, self._changed = self._changed, set()
            verdicts = [one for one in self._watched.standing() if one.entity in changed_now]
            return self._reported(verdicts, now, complete=False) if verdicts else []
        return []

    def _reported(self, verdicts: Sequence[Verdict], now: float, *, complete: bool) -> list[Outgoing]:
        self._changed.clear()
        self._soonest = now + SOONEST_S
        frames: list[Outgoing] = []
        if self._diagnostics:
            host_of: Callable[[EntityId], str] = Placed(self._watched.graph()).host_of
            statuses = diagnostics(verdicts, host_of)
            if complete:
                statuses += journal_statuses(self._journals(), self._host)
            frames += [Outgoing(VERSION, now, statuses=part) for part in _parts(statuses)]
        if self._rated:
            frames += self._messages(verdicts, now, complete=complete)
        return frames

    def _messages(self, verdicts: Sequence[Verdict], now: float, *, complete: bool) -> Iterator[Outgoing]:
        held = self._reference()
        if held is not self._held:
            self._held, self._ranges = held, ranges_of(held)
        signals = _parts(tuple(rated_signals(verdicts, self._ranges)))
        connections = _parts(connection_statistics(self._watched.readings(now)) if complete else ())
        count = max(len(signals), len(connections))
        for part in range(count):
            yield Outgoing(VERSION, now, rated=RatedSignals(
                self._host, complete, part, count,
                signals[part] if part < len(signals) else (),
                connections[part] if part < len(connections) else (),
            ))  # fmt: skip


def _parts(whole: tuple[_One, ...]) -> list[tuple[_One, ...]]:
    """Return at least one part."""
    return [whole[start : start + MOST_AT_ONCE] for start in range(0, max(len(whole), 1), MOST_AT_ONCE)]
