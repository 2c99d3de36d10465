"""How everything stands and what was measured of it, time after time, for who shows that to readers.

States are always those of the present: they change with news, or when the evaluator has them due. Values of what is
fine are read where somebody looks, and of everything else in turn, so that none is older than a round.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable
from itertools import islice
from typing import NamedTuple

from roslens.live.rate.verdict_list import VerdictList
from roslens.live.standing.standing import Standing
from roslens.live.system.live_tree import LiveTree
from roslens.live.system.topic import Topic
from roslens.live.system.tree import SystemView
from roslens.live.system.world import World
from roslens.model.verdict import Verdict

ROUND_S = 10.0
"""Every topic is evaluated within this many seconds, whether or not it is displayed."""
LEAST_LOOKS = 20
"""A round takes at least so many looks: who looks seldom has no more to do at each."""


class Glance(NamedTuple):
    """The tree of a system, and every verdict as it stands, sorted by entity and expectation."""

    view: SystemView
    standing: tuple[Verdict, ...]


class Turn(NamedTuple):
    """Topics to bring to the present: of ``still`` ones all is fine, and nothing was reported since they were read."""

    stirred: list[Topic]
    still: list[Topic]


class Glances:
    """Looks at one world again and again."""

    def __init__(self, world: World) -> None:
        self.tree = LiveTree(world)
        self._world = world
        self._place = 0
        self._looked = -math.inf
        self._verdicts = VerdictList()

    def turn(self, looked_at: Collection[str], now: float) -> Turn:
        """Return the topics to bring to ``now``: those looked at, what is not fine, and those whose turn it is."""
        known = self._world.topics
        found = {name: topic for name in looked_at if (topic := known.get(name)) is not None}
        found.update((topic.name, topic) for topic in self._in_turn(now))
        stirred = self._restless()
        for topic in stirred:
            found.pop(topic.name, None)
        still: list[Topic] = []
        for topic in found.values():
            (still if self.tree.holds(topic, now) else stirred).append(topic)
        return Turn(stirred, still)

    def at(self, standing: Iterable[Standing], now: float, turn: Turn) -> Glance:
        """Return how everything stands at ``now``, with values of topics that were just brought there."""
        listed = list(standing)
        # First the tree: to read values brings windows to the present, which verdicts quote as evidence.
        view = self.tree.view(listed, now, turn.stirred)
        return Glance(view, self._verdicts.of(listed, turn.stirred, turn.still))

    def _restless(self) -> list[Topic]:
        """Return the topics of which, or of whose connections, something is said that is not fine."""
        topics, connections = self._world.topics, self._world.connections
        names = dict.fromkeys(one.name for one in topics.values() if one.judged and not one.calm)
        names |= dict.fromkeys(one.topic for one in connections.values() if one.judged and not one.calm)
        return [topics[name] for name in names]

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
