"""How everything stands and what was measured of it, time after time, for who shows that to readers.

States are always those of the present: they change with news, or when the lookout has them due. Values of what is fine
are read where somebody looks, and of everything else in turn, so that none is older than a round.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from itertools import islice
from typing import NamedTuple

from roslens.judge.reference.expectation import Told
from roslens.live.standing.standing import Standing
from roslens.live.system.live_tree import LiveTree
from roslens.live.system.topic import Topic
from roslens.live.system.tree import SystemView
from roslens.live.system.world import World
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State, Verdict

ROUND_S = 10.0
"""In so many seconds every topic has its turn, whether or not somebody looks at it."""
LEAST_LOOKS = 20
"""A round takes at least so many looks: who looks seldom has no more to do at each."""
_OF_TRAFFIC = (EntityKind.TOPIC, EntityKind.CONNECTION)


class Glance(NamedTuple):
    """The tree of a system, and every verdict as it stands, sorted by entity and expectation."""

    view: SystemView
    standing: tuple[Verdict, ...]


class Glances:
    """Looks at one world again and again."""

    def __init__(self, world: World) -> None:
        self.tree = LiveTree(world)
        self._world = world
        self._place = 0
        self._looked = -math.inf
        self._listed: list[Standing] = []
        self._sorted: list[Standing] = []
        self._kept: dict[Standing, tuple[Verdict, Told]] = {}

    def topics(self, looked_at: Collection[str], now: float) -> list[Topic]:
        """Return the topics to bring to ``now``: those looked at, what is not fine, and those whose turn it is."""
        known = self._world.topics
        found = {name: topic for name in looked_at if (topic := known.get(name)) is not None}
        found.update((name, topic) for name, topic in known.items() if name not in found and not _calm(topic))
        found.update((topic.name, topic) for topic in self._in_turn(now))
        return list(found.values())

    def at(self, standing: Iterable[Standing], now: float, topics: Sequence[Topic]) -> Glance:
        """Return how everything stands at ``now``, with values of ``topics`` that were just brought there."""
        listed = list(standing)
        # First the tree: to read values brings windows to the present, which verdicts quote as evidence.
        view = self.tree.view(listed, now, topics)
        return Glance(view, self._verdicts(listed, topics))

    def _in_turn(self, now: float) -> list[Topic]:
        """Return the next topics of the round, as many as fit the time since the last ones."""
        count = len(self._world.topics)
        share = math.ceil(count * min(max(now - self._looked, 0.0) / ROUND_S, 1 / LEAST_LOOKS))
        self._looked = now
        if self._place >= count:
            self._place = 0
        found = list(islice(self._world.topics.values(), self._place, self._place + share))
        self._place += share
        return found

    def _verdicts(self, listed: list[Standing], topics: Iterable[Topic]) -> tuple[Verdict, ...]:
        """Return all verdicts; those of what is fine and was not looked at are the same objects as before."""
        if listed != self._listed:
            self._listed, self._sorted = listed, sorted(listed, key=lambda one: one.key)
            there = set(listed)
            self._kept = {one: kept for one, kept in self._kept.items() if one in there}
        fresh = {entity for topic in topics for entity in _entities(topic)}
        kept = self._kept
        found = []
        for one in self._sorted:
            known = kept.get(one)
            if known is None or not _holds(one, *known, fresh):
                known = kept[one] = one.verdict(), one.told
            found.append(known[0])
        return tuple(found)


def _holds(one: Standing, verdict: Verdict, told: Told, fresh: Collection[EntityId]) -> bool:
    """Whether what was said of something holds: it is fine as it was, and nobody brought its values to the present."""
    state = one.state
    if verdict.state is not State.OK or state.state is not State.OK or state.since != verdict.since:
        return False
    return one.told is told and one.entity.kind in _OF_TRAFFIC and one.entity not in fresh


def _entities(topic: Topic) -> Iterable[EntityId]:
    yield topic.id
    for connections in topic.connections.values():
        for one in connections:
            yield one.id


def _calm(topic: Topic) -> bool:
    """Whether everything that is said of a topic and its connections is fine."""
    if topic.judged and not topic.calm:
        return False
    for connections in topic.connections.values():
        for one in connections:
            if one.judged and not one.calm:
                return False
    return True
