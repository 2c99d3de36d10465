"""The verdicts that are bad at this moment, each with the fault that explains it."""

from __future__ import annotations

from roslens.live.causes import first_causes
from roslens.live.standing import Standing
from roslens.live.world import World
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State


class Explained:
    """Keeps the bad verdicts, and looks for their causes again when these or the graph changed."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._bad: set[Standing] = set()
        self.stale = False

    def note(self, one: Standing) -> None:
        """Take a verdict that changed."""
        if one.state.state.bad:
            self._bad.add(one)
            self.stale = True
        elif one in self._bad:
            self.drop(one)

    def drop(self, one: Standing) -> None:
        """Forget a verdict."""
        if one in self._bad:
            self._bad.remove(one)
            one.cause = ""
            self.stale = True

    def explain(self) -> list[Standing]:
        """Give each bad verdict its cause; return those of which it changed."""
        if not self.stale:
            return []
        self.stale = False
        since: dict[EntityId, float] = {}
        for one in self._bad:
            since[one.entity] = min(since.get(one.entity, one.state.since), one.state.since)
        causes = first_causes(since, self._fine, self._world.upstream)
        changed = []
        for one in self._bad:
            known = causes.get(one.entity)
            cause = str(known) if known is not None else ""
            if cause != one.cause:
                one.cause = cause
                changed.append(one)
        return changed

    def _fine(self, entity: EntityId) -> bool:
        if entity.kind is not EntityKind.TOPIC:
            return False
        topic = self._world.topics.get(entity.name)
        if topic is None or not topic.judged:
            return False
        return all(one.state.state is State.OK for one in topic.judged)
