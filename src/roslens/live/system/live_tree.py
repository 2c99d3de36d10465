"""The tree of a system that runs, time after time: what did not change is the same object as before."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from roslens.live.standing.standing import Standing
from roslens.live.system.readings import Readings
from roslens.live.system.topic import Topic
from roslens.live.system.tree import Plan, SystemView
from roslens.live.system.world import World
from roslens.model.entity import EntityId
from roslens.model.graph import Graph
from roslens.model.verdict import State


class LiveTree:
    """Makes the trees of one world."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._readings = Readings(world)
        self._plan: Plan | None = None
        self._shape: _Shape | None = None
        self._states: dict[EntityId, list[State]] = {}

    def view(self, standing: Iterable[Standing], now: float, topics: Sequence[Topic] | None = None) -> SystemView:
        """Return the tree at ``now``; an entity below several others counts once in what is above them all.

        Values of traffic are read anew where ``topics`` have it, by default everywhere.
        """
        states: dict[EntityId, list[State]] = {}
        for one in standing:
            states.setdefault(one.entity, []).append(one.state.state)
        read = self._readings.refresh(now, topics)
        if self._plan is None or self._shape is None or not self._shape.fits(self._world, states):
            if self._plan is not None:
                self._plan.dissolve()
            self._plan = Plan(_Placed(self._world, self._readings), states)
            self._shape = _Shape(self._world, states)
        else:
            before = self._states
            self._plan.change(read, [entity for entity, found in states.items() if before[entity] != found])
        self._states = states
        return self._plan.view(self._readings.of, states)


class _Shape:
    """What decides where everything stands: while it is the same, nothing has to be placed again."""

    def __init__(self, world: World, states: Collection[EntityId]) -> None:
        self._graph: Graph | None = world.graph
        self._sampled = set(world.sampled)
        self._topics = set(world.topics)
        self._connections = set(world.connections)
        self._judged = set(states)

    def fits(self, world: World, states: dict[EntityId, list[State]]) -> bool:
        """Return whether a system is still of this shape."""
        return (
            world.graph is self._graph
            and world.sampled.keys() == self._sampled
            and world.topics.keys() == self._topics
            and world.connections.keys() == self._connections
            and states.keys() == self._judged
        )


class _Placed:
    """The parts of a system that runs."""

    def __init__(self, world: World, readings: Readings) -> None:
        self._world = world
        self.graph = world.graph
        self.sampled: Collection[EntityId] = world.sampled
        self.topics: Iterable[str] = world.topics
        self.host_of = world.host_of
        self.values_of = readings.of

    def publishers_of(self, topic: str) -> Iterable[str]:
        known = self._world.topics[topic]
        return {*(known.publishers or known.former), *filter(None, known.connections)}

    def connections_of(self, topic: str, node: str) -> Iterable[EntityId]:
        return [one.id for one in self._world.topics[topic].connections.get(node, ())]
