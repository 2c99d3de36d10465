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
        self._judged: list[Standing] = []
        self._found: list[State] = []

    def holds(self, topic: Topic, now: float) -> bool:
        """Return whether values of a topic and its connections are at ``now`` what they were when they were read."""
        return self._readings.holds(topic, now)

    def view(self, standing: Iterable[Standing], now: float, topics: Sequence[Topic] | None = None) -> SystemView:
        """Return the tree at ``now``; an entity below several others counts once in what is above them all.

        Values of traffic are read anew where ``topics`` have it, by default everywhere.
        """
        states = self._states_of(list(standing))
        read = self._readings.refresh(now, topics)
        if self._plan is None or self._shape is None or not self._shape.fits(self._world, states, self._states):
            if self._plan is not None:
                self._plan.dissolve()
            self._plan = Plan(_Placed(self._world, self._readings), states)
            self._shape = _Shape(self._world, states)
        else:
            before = self._states
            same = states is before
            moved = () if same else [entity for entity, found in states.items() if before[entity] != found]
            self._plan.change(read, moved)
        self._states = states
        return self._plan.view(self._readings.of, states)

    def _states_of(self, judged: list[Standing]) -> dict[EntityId, list[State]]:
        """Return how each entity stands: the same object as before where nothing of that changed."""
        found = [one.state.state for one in judged]
        if judged == self._judged and found == self._found:
            return self._states
        self._judged, self._found = judged, found
        states: dict[EntityId, list[State]] = {}
        for one in judged:
            states.setdefault(one.entity, []).append(one.state.state)
        return states


class _Shape:
    """What decides where everything stands: while it is the same, nothing has to be placed again."""

    def __init__(self, world: World, states: Collection[EntityId]) -> None:
        self._graph: Graph | None = world.graph
        # In the order in which they came: the same objects as long as nothing comes or goes, so that none is hashed.
        self._sampled = list(world.sampled)
        self._topics = list(world.topics)
        self._connections = list(world.connections)
        self._judged = set(states)

    def fits(self, world: World, states: Collection[EntityId], before: Collection[EntityId]) -> bool:
        """Return whether a system is still of this shape; ``before`` are the entities that were judged last."""
        return (
            world.graph is self._graph
            and list(world.sampled) == self._sampled
            and list(world.topics) == self._topics
            and list(world.connections) == self._connections
            and (states is before or set(states) == self._judged)
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
