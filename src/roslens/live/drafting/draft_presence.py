"""What a reference could require to be present: nodes, topics and services of a graph, or of a watch, by the second."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

import msgspec

from roslens.live.drafting.draft_lines import expected_alarms
from roslens.model.graph import Graph, Role

PLUMBING = frozenset({"/rosout", "/rosout_agg", "/parameter_events"})
"""Topics that every node has."""
MADE_UP = re.compile(r"[0-9]{4,}|(^|/)_")
"""Names with the number of a process or the time in them, and hidden ones: the next start makes others."""
OF_MANY_NODES = re.compile(
    r"/(describe_parameters|get_parameters|get_parameter_types|list_parameters|set_parameters|set_parameters_atomically"
    r"|get_type_description|get_state|change_state|get_available_states|get_available_transitions"
    r"|get_transition_graph|get_loggers|set_logger_level|_action/[a-z_]+)\Z"
)
"""Services that many nodes have, and that tools call."""


class There(msgspec.Struct, frozen=True, order=True):
    """Something that could always be there.

    Attributes:
        kind: ``node``, ``topic`` or ``service``.
        name: of it.
        type: of a topic, where there is only one.
        looks: how often it could have been seen; 0 of a graph that was given.
        seen: how often it was.
        losses: how often it was there, and at the next look was not.
        hours: that the looks cover.
    """

    kind: str
    name: str
    type: str = ""
    looks: int = 0
    seen: int = 0
    losses: int = 0
    hours: float = 0.0

    @property
    def alarms_per_hour(self) -> float:
        """Expected alarms an hour."""
        return expected_alarms(self.losses, self.hours)


class Attendance:
    """Counts at every look what is there."""

    def __init__(self) -> None:
        self._looks = 0
        self._seen: dict[tuple[str, str], tuple[int, int, int]] = {}
        self._types: dict[str, set[str]] = {}

    def look(self, graph: Graph) -> None:
        """Note what a graph has at the next look."""
        self._looks += 1
        for key in _present(graph, self._types):
            seen, last, losses = self._seen.get(key, (0, self._looks - 1, 0))
            self._seen[key] = seen + 1, self._looks, losses + (last < self._looks - 1)

    def drafted(self, seconds: float) -> tuple[There, ...]:
        """Return what was there at the end and at half of the looks since it came, of a watch of so many seconds."""
        hours = seconds / 3600
        return tuple(
            There(kind, name, _only(self._types.get(name, ())), self._looks, seen, losses, hours)
            for (kind, name), (seen, last, losses) in sorted(self._seen.items())
            if last == self._looks and 2 * seen >= self._looks and not MADE_UP.search(name)
        )

    def left_out(self) -> tuple[str, ...]:
        """Return the nodes that came or went, or whose names another start would not make again."""
        kept = {(one.kind, one.name) for one in self.drafted(1.0)}
        return tuple(sorted(name for kind, name in self._seen if kind == "node" and (kind, name) not in kept))


def there_in(graph: Graph) -> tuple[There, ...]:
    """Return nodes, topics and services of a graph that was written down."""
    types: dict[str, set[str]] = {}
    return tuple(
        There(kind, name, _only(types.get(name, ())) if kind == "topic" else "")
        for kind, name in sorted(_present(graph, types))
        if not MADE_UP.search(name)
    )


def _present(graph: Graph, types: dict[str, set[str]]) -> set[tuple[str, str]]:
    found = {("node", node.name) for node in graph.nodes}
    for end in graph.endpoints:
        if end.role is Role.PUBLISHER and end.name not in PLUMBING:
            found.add(("topic", end.name))
            if end.type:
                types.setdefault(end.name, set()).add(end.type)
        elif end.role is Role.SERVICE_SERVER and not OF_MANY_NODES.search(end.name):
            found.add(("service", end.name))
    return found


def _only(types: Iterable[str]) -> str:
    several = list(types)
    return several[0] if len(several) == 1 else ""


def types_in(graph: Graph) -> Mapping[str, str]:
    """Return the types of topics that have only one."""
    types: dict[str, set[str]] = {}
    _present(graph, types)
    return {name: _only(found) for name, found in sorted(types.items()) if _only(found)}
