"""What is between nodes and topics of a running system: a line from who publishes, one to who subscribes."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

import msgspec

from roslens.dashboard.live.snapshot import UNJUDGED, Row
from roslens.live.system.connection_name import connection_ends
from roslens.model.entity import EntityId
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.verdict import State

WORSE = {state: place for place, state in enumerate((UNJUDGED, *(state.value for state in State)))}
"""By state how bad it is."""
_PUBLISHES, _SUBSCRIBES = Role.PUBLISHER, Role.SUBSCRIPTION
_DIGITS = 3

Ends = tuple[str, str]
"""From which entity to which, in the text form of their ids."""


class HalfLine(msgspec.Struct):
    """What is known of a line; ages and latencies in seconds, None where nothing tells them.

    Attributes:
        state: of the topic, or of the connection.
        rate: as people read it.
        latency: as people read it.
        bandwidth: as people read it.
        age: mean time from the stamp in the header to receipt.
        lag: mean time from publishing to receipt.
    """

    state: str = UNJUDGED
    rate: str = ""
    latency: str = ""
    bandwidth: str = ""
    age: float | None = None
    lag: float | None = None

    def take(self, row: Row) -> None:
        """Take the values of a row."""
        self.rate, self.bandwidth = row.shown.get("rate", ""), row.shown.get("bandwidth", "")
        self.latency = row.shown.get("latency", "") if row.kind == "connection" else ""
        self.age, self.lag = _rounded(row.values.get("age")), _rounded(row.values.get("latency"))


def _rounded(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.{_DIGITS}g}")


def worse(one: str, other: str) -> str:
    """Return the worse of two states."""
    return max(one, other, key=WORSE.__getitem__)


def encodable(text: str) -> str:
    """Return a text that can be written as UTF-8: what cannot is replaced."""
    return text if text.isascii() else text.encode("utf-8", "replace").decode()


@lru_cache(maxsize=65536)
def ends_of(connection: str) -> tuple[str, str, str]:
    """Return topic, publisher and subscriber of the text form of the id of a connection; unknown ones are empty."""
    return connection_ends(EntityId.parse(connection))


def half_lines(joined: Iterable[Ends], rows: Iterable[Row]) -> dict[Ends, HalfLine]:
    """Return every line from a node to a topic and from a topic to a node.

    Args:
        joined: what the graph joins, each once.
        rows: of the tree.
    """
    lines = {ends: HalfLine() for ends in joined}
    node = ""
    for row in rows:
        if row.kind == "node":
            node = row.entity
        elif row.kind == "topic" and node and node != "node:":
            line = lines.setdefault((node, row.entity), HalfLine())
            line.state = row.state
            line.take(row)
        elif row.kind == "connection":
            topic, _, subscriber = ends_of(row.entity)
            if subscriber:
                line = lines.setdefault((f"topic:{topic}", f"node:{subscriber}"), HalfLine(row.state))
                line.state = worse(line.state, row.state)
                line.take(row)
    return lines


def fed_by(rows: Iterable[Row]) -> dict[int, Ends]:
    """Return of which line each row tells the values, by its place; of several rows the last one tells them."""
    last: dict[Ends, int] = {}
    node = ""
    for place, row in enumerate(rows):
        if row.kind == "node":
            node = row.entity
        elif row.kind == "topic" and node and node != "node:":
            last[node, row.entity] = place
        elif row.kind == "connection":
            topic, _, subscriber = ends_of(row.entity)
            if subscriber:
                last[f"topic:{topic}", f"node:{subscriber}"] = place
    return {place: ends for ends, place in last.items()}


def joined_by(graph: Graph) -> tuple[Ends, ...]:
    """Return which node a graph joins to which topic and which topic to which node, each once."""
    return tuple(dict.fromkeys(ends for one in graph.endpoints if (ends := _ends(one)) is not None))


def _ends(endpoint: Endpoint) -> Ends | None:
    node, topic = encodable(f"node:{endpoint.node}"), encodable(f"topic:{endpoint.name}")
    if endpoint.role is _PUBLISHES:
        return node, topic
    return (topic, node) if endpoint.role is _SUBSCRIBES else None
