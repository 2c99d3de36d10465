"""The computation graph as JSON: who asks a monitor for it reads it as a :class:`roslens.model.graph.Graph` again."""

from __future__ import annotations

import msgspec

from roslens.model.graph import Graph


def graph_bytes(graph: Graph) -> bytes:
    """Return a graph as JSON; what of its names cannot be encoded is replaced."""
    try:
        return msgspec.json.encode(graph)
    except UnicodeEncodeError:
        return msgspec.json.encode(_encodable(msgspec.to_builtins(graph)))


def _encodable(value: object) -> object:
    if isinstance(value, str):
        return value.encode("utf-8", "replace").decode()
    if isinstance(value, dict):
        return {_encodable(key): _encodable(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_encodable(inner) for inner in value]
    return value
