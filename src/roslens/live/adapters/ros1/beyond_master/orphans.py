"""Nodes that a restarted master does not know: they run on and exchange messages, for no node registers again."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from roslens.live.adapters.ros1.master import Registrations, SystemState
from roslens.live.adapters.ros1.names import TOOL
from roslens.model.failure import Failure

_NAMED = 5


class Orphans:
    """Remembers the registrations of such nodes, until they register again or end.

    Attributes:
        names: of the nodes.
    """

    def __init__(self) -> None:
        """Begin without any."""
        self.names: frozenset[str] = frozenset()
        self._state = SystemState()
        self._types: dict[str, str] = {}

    def adopt(self, before: SystemState, types: Mapping[str, str], alive: Collection[str]) -> None:
        """Take the nodes that were registered at the master before and are ``alive``, with the types of topics."""
        self._types = {**self._types, **types}
        self._state = _of(_union(self._state, before), alive)
        self.names = frozenset(self._state.nodes)

    def follow(self, state: SystemState, alive: Collection[str]) -> None:
        """Let those go that are registered again, or are not ``alive`` any more."""
        if self.names:
            self._state = _of(self._state, self.names.intersection(alive) - {*state.nodes})
            self.names = frozenset(self._state.nodes)

    def with_state(self, state: SystemState) -> SystemState:
        """Return what is registered at the master, with what these nodes have."""
        return _union(state, self._state) if self.names else state

    def with_types(self, types: Mapping[str, str]) -> Mapping[str, str]:
        """Return the types of topics that the master knows, and of those of these nodes."""
        return {**self._types, **types} if self.names else types

    def failures(self) -> list[Failure]:
        """Return what is to be said of them."""
        if not self.names:
            return []
        names = sorted(self.names)
        more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
        text = f"the ROS master was restarted and does not know {', '.join(names[:_NAMED])}{more}, which run on"
        advice = "Start them again: they find no new node, and no new node finds them"
        return [Failure(TOOL, text, "nodes that are registered at the master", advice, partial=True)]


def _union(one: SystemState, other: SystemState) -> SystemState:
    def part(first: Registrations, second: Registrations) -> Registrations:
        return tuple(sorted({*first, *second}))

    return SystemState(
        part(one.publishers, other.publishers), part(one.subscribers, other.subscribers),
        part(one.services, other.services), one.oddities,
    )  # fmt: skip


def _of(state: SystemState, nodes: Collection[str]) -> SystemState:
    """Return what some nodes are registered for."""

    def part(pairs: Registrations) -> Registrations:
        return tuple(pair for pair in pairs if pair[1] in nodes)

    return SystemState(part(state.publishers), part(state.subscribers), part(state.services))
