"""Lifecycle states and parameters that could be required: those that stayed as they are."""

from __future__ import annotations

import msgspec

from roslens.judge.reading.read_state_check import number_range
from roslens.live.drafting.draft_presence import MADE_UP
from roslens.live.reported.parameter_text import HIDDEN, LONGEST
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph

_OF_EVERY_NODE = ("qos_overrides.", "start_type_description_service")
"""What begins the names of parameters that the client library makes."""
_UNSET = ("", "not set", HIDDEN)


class Kept(msgspec.Struct, frozen=True, order=True):
    """A state of a node or a value of a parameter.

    Attributes:
        entity: that has it.
        value: the newest.
        looks: at how many it was reported.
        changes: how often it was another one than at the look before.
        hours: that the looks cover.
    """

    entity: EntityId
    value: str
    looks: int
    changes: int
    hours: float


class States:
    """Notes at every look what nodes report of their states and parameters."""

    def __init__(self) -> None:
        self._seen: dict[EntityId, tuple[str, int, int, int]] = {}
        self._looks = 0

    def look(self, graph: Graph) -> None:
        """Take what a graph has at the next look."""
        self._looks += 1
        for node in graph.nodes:
            if node.lifecycle:
                self._note(EntityId(EntityKind.NODE, node.name), node.lifecycle)
        for name, parameters in graph.parameters.items():
            for parameter, value in parameters.items():
                if value not in _UNSET and not parameter.startswith(_OF_EVERY_NODE):
                    self._note(EntityId(EntityKind.PARAMETER, f"{name}/{parameter}"), value)

    def drafted(self, seconds: float) -> tuple[Kept, ...]:
        """Return what was reported at the last look, of a watch of so many seconds."""
        hours = seconds / 3600
        return tuple(
            Kept(entity, value, looks, changes, hours * looks / self._looks)
            for entity, (value, looks, changes, last) in sorted(self._seen.items())
            if last == self._looks and not MADE_UP.search(entity.name) and _expressible(entity, value)
        )

    def _note(self, entity: EntityId, value: str) -> None:
        before, looks, changes, _ = self._seen.get(entity, (value, 0, 0, 0))
        self._seen[entity] = value, looks + 1, changes + (value != before), self._looks


def _expressible(entity: EntityId, value: str) -> bool:
    """Return whether a reference can require exactly this value; a long one is known in part only."""
    return entity.kind is EntityKind.NODE or (len(value) < LONGEST and number_range((value,)) is None)
