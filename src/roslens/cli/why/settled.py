"""When enough of a running system was seen to answer: who should be there is, or nothing new has come for longer."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from roslens.model.graph import Role

if TYPE_CHECKING:
    from roslens.live.join.session import Session
    from roslens.model.graph import Graph

THERE_S = 0.3
"""How long nothing new has to come where somebody makes what is asked about; a graph has waited for 0.5 s before."""
ABSENT_S = 1.2
"""The same where nobody does: participants of DDS announce themselves several times in their first second."""
_MAKING = (Role.PUBLISHER, Role.SERVICE_SERVER, Role.ACTION_SERVER)


class Settled:
    """Tells when a graph has stayed as it is for a while, and what is counted of an entity has a rate."""

    def __init__(self, session: Session, name: str, *, steady: Callable[[], float] = time.monotonic) -> None:
        """Watch what ``session`` sees; ``name`` is asked about."""
        self._session = session
        self._name = name
        self._steady = steady
        self._shape: object = None
        self._since = 0.0
        self._there = self._seen = False

    def take(self, graph: Graph | None) -> None:
        """Take a graph where it changed; identifiers and parameters may change for as long as they like."""
        if graph is None:
            return
        shape = (
            frozenset((one.name, one.lifecycle, one.pid, len(one.instances)) for one in graph.nodes),
            frozenset((one.node, one.role, one.name, one.type, one.qos) for one in graph.endpoints),
        )
        if shape != self._shape:
            self._shape, self._since = shape, self._steady()
        self._seen = bool(graph.nodes)
        self._there = any(one.name == self._name and one.role in _MAKING for one in graph.endpoints) or any(
            one.name == self._name for one in graph.nodes
        )

    def over(self, now: float) -> bool:
        """Return whether enough was seen at ``now``, seconds on the session's clock; never where no node was."""
        if not self._session.begun or not self._seen:
            return False
        quiet = self._steady() - self._since
        return quiet >= (THERE_S if self._there else ABSENT_S) and not self._is_awaited(now)

    def _is_awaited(self, now: float) -> bool:
        """Return whether the entity is counted and nothing came yet."""
        return any(
            values.get("rate") == 0.0 for entity, values in self._session.readings(now) if entity.name == self._name
        )
