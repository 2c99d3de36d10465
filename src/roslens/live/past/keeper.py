"""Writes a session into a history: values, verdicts and events, and now and then how everything stands."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.entity import EntityId
from roslens.store.live.history import History
from roslens.store.live.series import Tier
from roslens.store.past.moment import Moment

if TYPE_CHECKING:
    from roslens.live.join.session import Session, Step
    from roslens.live.system.tree import SystemView
    from roslens.store.past.recall import Recall

MOST_VALUES = 2000.0
"""Values a second that are kept; of a larger system each is kept less often."""
IN_MEMORY = (Tier(1, 900), Tier(10, 3600), Tier(60, 6 * 3600))
MOST_IN_MEMORY = 1000.0
"""Values a second: then a quarter of an hour by seconds takes some 50 MB."""
_LET_GO_S = 60.0
_PRUNE_S = 60.0
"""So what is kept is hardly more than its tiers ask for; to give up a little often is no stall."""
_LEAST_CHANGES = 500
"""Verdicts that change until a moment is kept anew, or as many as stand: so each costs the same, however many."""
_SHARE = 1000
"""Of a large system the graph is kept once in a second for each so many of its parts."""


class Keeper:
    """Keeps one session in one history."""

    def __init__(
        self, session: Session, history: History, *, most_values: float = float("inf"), flush_s: float = 5.0
    ) -> None:
        """Keep what ``session`` does in ``history``: at most so many values a second, written so often."""
        self._flush_s = flush_s
        self._session = session
        self._history = history
        self._most = most_values
        self._values_due = self._flush_due = self._moment_due = 0.0
        self._let_go_due = self._prune_due = 0.0
        self._changes = 0
        self._stood = 0
        self._stale = True

    def take(self, step: Step) -> None:
        """Keep a step.

        Raises:
            StoreError: the history cannot be written.
        """
        now, history = step.time, self._history
        history.add_verdicts((*step.changes, *step.causes))
        history.add_events(step.events)
        self._changes += len(step.changes) + len(step.causes)
        self._stale |= step.graph is not None
        if now >= self._values_due:
            self._keep_values(now)
        if now >= self._moment_due:
            self._keep_moment(now)
        if now >= self._flush_due:
            self._flush_due = now + self._flush_s
            history.flush()
        self._clean(now)

    def recall(self) -> Recall:
        """Return what reads what is kept."""
        return self._history.recall()

    def end(self) -> None:
        """Write what waits.

        Raises:
            StoreError: the history cannot be written.
        """
        self._history.flush(final=True)

    def _keep_values(self, now: float) -> None:
        count = 0
        for entity, values in self._session.readings(now):
            self._history.add_values(str(entity), now, values)
            count += len(values)
        self._values_due = now + max(1.0, count / self._most)

    def _keep_moment(self, now: float) -> None:
        # By how many stood at the last one: to ask how everything stands brings all of it to the present.
        if not self._stale and self._changes < max(_LEAST_CHANGES, self._stood):
            return
        moment = moment_of(self._session, now)
        self._history.add_moment(moment)
        self._stale, self._changes, self._stood = False, 0, len(moment.verdicts)
        parts = len(moment.verdicts) + len(moment.graph.endpoints)
        self._moment_due = now + max(1.0, parts / _SHARE)

    def _clean(self, now: float) -> None:
        if not self._let_go_due:
            self._let_go_due, self._prune_due = now + _LET_GO_S, now + _PRUNE_S
        if now >= self._let_go_due:
            self._let_go_due = now + _LET_GO_S
            self._history.let_go(now)
        if now >= self._prune_due:
            self._prune_due = now + _PRUNE_S
            self._history.prune(now)


def in_memory(session: Session) -> Keeper:
    """Return what keeps the last hours of a session in memory."""
    return Keeper(session, History.open(None, IN_MEMORY), most_values=MOST_IN_MEMORY, flush_s=1.0)


def moment_of(session: Session, now: float) -> Moment:
    """Return how everything stands in a session at ``now``, without values."""
    world = session.monitor.world
    former = {
        topic.name: tuple(sorted(topic.former))
        for topic in world.topics.values()
        if topic.former and not topic.publishers
    }
    graph = session.graph()
    nodes = {node.name for node in graph.nodes}.union(*former.values())
    nodes.update(one.name for one in world.sampled if one.kind.value == "node")
    return Moment(
        now,
        graph,
        session.monitor.standing(),
        former,
        {name: host for name in sorted(nodes) if (host := world.host_of(name))},
        _observers(session.tree(now)),
    )


def _observers(whole: SystemView) -> dict[str, str]:
    found: dict[str, str] = {}
    waiting = [whole]
    while waiting:
        part = waiting.pop()
        if part.observer:
            found[str(EntityId.parse(part.id))] = part.observer
        waiting += part.children
    return found
