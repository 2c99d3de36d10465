"""What exists: by the graph, by events, and by what is sampled or told of it."""

from __future__ import annotations

from roslens.live.standing.presence import Key, Presences
from roslens.live.standing.rulebook import Facts
from roslens.live.system.sampled import Sampled
from roslens.live.system.world import World
from roslens.live.window.newest import keep_newest
from roslens.model.entity import EntityKind
from roslens.model.graph import Graph


class Existence:
    """Tells presences what appears and vanishes.

    A host of which there are samples lives as long as they come, whatever the graph remembers of it. What an event
    said to have vanished stays so until a later graph, sample or event has it.

    Attributes:
        presences: that are told; replaced with the reference.
        vanished: when what is gone went, of what went last.
    """

    def __init__(self, world: World, presences: Presences) -> None:
        self.presences = presences
        self.vanished: dict[Key, float] = {}
        self._world = world
        self._by_graph: set[Key] = set()

    def take_graph(self, graph: Graph, time: float, now: float) -> None:
        """Take what a graph has, and note what it has no more."""
        existing = self._world.existing(graph)
        for key, facts in existing.items():
            if self.vanished.get(key, time) <= time and not self._stale_host(key, now):
                self.appear(key, facts)
        for key in self._by_graph - existing.keys():
            if not self._sampled(key, now):
                self.vanish(key, time)
        self._by_graph = set(existing)
        for sampled in self._world.sampled.values():
            sampled.known = (sampled.id.kind, sampled.id.name) in existing

    def take_sample(self, sampled: Sampled, time: float) -> None:
        """Note that something was sampled."""
        key = (sampled.id.kind, sampled.id.name)
        if key not in self.presences.existing and time > self.vanished.get(key, time - 1):
            self.appear(key, self._world.facts(sampled))

    def take_silence(self, sampled: Sampled, now: float) -> None:
        """Note that nothing is sampled of an entity any more."""
        key = (sampled.id.kind, sampled.id.name)
        if key in self.presences.existing and (not sampled.known or sampled.id.kind is EntityKind.HOST):
            self.vanish(key, sampled.noticed if sampled.seen else now)

    def appear(self, key: Key, facts: Facts) -> None:
        """Note that something is there."""
        self.vanished.pop(key, None)
        self.presences.appear(key, facts)

    def vanish(self, key: Key, time: float) -> None:
        """Note that something is gone since ``time``."""
        if key in self.presences.existing:
            self.vanished.pop(key, None)
            self.vanished[key] = time
            keep_newest(self.vanished)
            self.presences.vanish(key)

    def _sampled(self, key: Key, now: float) -> bool:
        sampled = self._world.sampled_by(key)
        return sampled is not None and sampled.seen and sampled.fresh(now) and key[0] is EntityKind.HOST

    def _stale_host(self, key: Key, now: float) -> bool:
        sampled = self._world.sampled_by(key) if key[0] is EntityKind.HOST else None
        return sampled is not None and sampled.seen and not sampled.fresh(now)
