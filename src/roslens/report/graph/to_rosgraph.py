"""A computation graph as a rosgraph_msgs/msg/Graph in YAML: what programs that know this message can read.

The fields are those of rosgraph_msgs in rcl_interfaces. What the message cannot say of a system that roslens watches is
left out: hosts, processes, states of a lifecycle. What roslens does not know is as the message says it: a quality of
service as unknown, a type hash as one of version 0, a parameter as the text that is shown of it.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from math import isfinite

from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.qos import Qos

_HISTORY = {"keep_last": 1, "keep_all": 2, "": 3}
_RELIABILITY = {"reliable": 1, "best_effort": 2, "": 3}
_DURABILITY = {"transient_local": 1, "volatile": 2, "": 3}
_LIVELINESS = {"automatic": 1, "manual_by_topic": 3, "": 4}
_HASH = re.compile(r"RIHS([0-9]{2})_([0-9a-f]{64})\Z")
_HASH_BYTES = 32
_BOOL, _INTEGER, _DOUBLE, _STRING = 1, 2, 3, 4
_SCALARS = {_BOOL: "bool", _INTEGER: "integer", _DOUBLE: "double", _STRING: "string"}
_TO_ARRAY = 5
"""What the number of an array's type has more than that of its items (rcl_interfaces, ParameterType)."""
_NUMBER = re.compile(r"-?(?:[0-9]+\.[0-9]*(?:e[+-]?[0-9]+)?|[0-9]+e[+-]?[0-9]+)\Z")
_INTEGER_BITS = 63
_PLAIN = frozenset(map(chr, range(0x20, 0x7F))) - {'"', "\\"}
_FIELDS = {
    Role.PUBLISHER: "publishers",
    Role.SUBSCRIPTION: "subscriptions",
    Role.SERVICE_CLIENT: "service_clients",
    Role.SERVICE_SERVER: "service_servers",
    Role.ACTION_CLIENT: "action_clients",
    Role.ACTION_SERVER: "action_servers",
}
_Message = Mapping[str, object]


def to_rosgraph(graph: Graph) -> str:
    """Return a graph as the YAML of a message, nodes and their endpoints sorted by name."""
    return "\n".join(_yaml({"nodes": list(_nodes(graph))}, "")) + "\n"


def _nodes(graph: Graph) -> Iterator[_Message]:
    ends: dict[str, list[Endpoint]] = {node.name: [] for node in graph.nodes}
    for end in graph.endpoints:
        ends.setdefault(end.node, []).append(end)
    # The publisher of a message in a recording may be unknown.
    for name in sorted(ends):
        mine = sorted(ends[name], key=lambda end: (end.name, end.type, end.gid))
        parameters = sorted(graph.parameters.get(name, {}).items())
        node: dict[str, object] = {"parameters": [{"name": key} for key, _ in parameters]}
        for role, field in _FIELDS.items():
            node[field] = [_end(end) for end in mine if end.role is role]
        node["name"] = name
        node["parameter_values"] = [_value(text) for _, text in parameters]
        yield node


def _end(end: Endpoint) -> _Message:
    if end.role in (Role.PUBLISHER, Role.SUBSCRIPTION):
        return {"name": end.name, "type": _type(end.type, end.hash), "qos": _qos(end.qos)}
    parts = ("Request", "Response") if "service" in end.role.value else ("Goal", "Result", "Feedback")
    fields = ("request_type", "response_type", "feedback_type")
    types = {field: _type(f"{end.type}_{part}" if end.type else "") for field, part in zip(fields, parts, strict=False)}
    return {"name": end.name, **types}


def _type(name: str, text: str = "") -> _Message:
    known = _HASH.match(text)
    value = list(bytes.fromhex(known[2])) if known else [0] * _HASH_BYTES
    return {"name": name, "hash": {"version": int(known[1]) if known else 0, "value": value}}


def _qos(qos: Qos | None) -> _Message:
    known = qos or Qos()
    return {
        "depth": known.depth,
        "deadline": _duration(known.deadline_s),
        "lifespan": _duration(known.lifespan_s),
        "history": _HISTORY.get(known.history, 3),
        "reliability": _RELIABILITY.get(known.reliability, 3),
        "durability": _DURABILITY.get(known.durability, 3),
        "liveliness": _LIVELINESS.get(known.liveliness, 4),
        "liveliness_lease_duration": _duration(known.lease_s),
    }


def _duration(seconds: float) -> _Message:
    whole, nanoseconds = divmod(round(seconds * 1e9), 10**9)
    return {"sec": whole, "nanosec": nanoseconds}


def _value(text: str) -> _Message:
    """Return a value by what its text looks like; a text that looks like a number or a list is taken for one."""
    if text.startswith("[") and text.endswith("]"):
        return _values([part.strip() for part in text[1:-1].split(",") if part.strip()])
    kind, value = _scalar(text)
    return {"type": kind, f"{_SCALARS[kind]}_value": value}


def _values(items: list[str]) -> _Message:
    """Return a list: of texts where its items differ, or there are none."""
    found = [_scalar(one) for one in items]
    kinds = {kind for kind, _ in found}
    if kinds == {_INTEGER, _DOUBLE}:
        found, kinds = [(_DOUBLE, float(one)) for one in items], {_DOUBLE}
    kind = kinds.pop() if len(kinds) == 1 else _STRING
    values = [value for _, value in found] if kind != _STRING else [one.strip("'\"") for one in items]
    return {"type": kind + _TO_ARRAY, f"{_SCALARS[kind]}_array_value": values}


def _scalar(text: str) -> tuple[int, object]:
    if text in ("true", "false"):
        return _BOOL, text == "true"
    try:
        whole = int(text)
        if abs(whole) < 1 << _INTEGER_BITS:
            return _INTEGER, whole
    except ValueError:
        pass
    if _NUMBER.match(text) and isfinite(number := float(text)):
        return _DOUBLE, number
    return _STRING, text


def _yaml(message: Mapping[str, object], indent: str) -> Iterator[str]:
    for key, value in message.items():
        if isinstance(value, Mapping):
            yield f"{indent}{key}:"
            yield from _yaml(value, f"{indent}  ")
        elif isinstance(value, Sequence) and not isinstance(value, str) and value and isinstance(value[0], Mapping):
            yield f"{indent}{key}:"
            for one in value:
                first, *others = _yaml(one, f"{indent}  ")
                yield f"{indent}- {first.lstrip()}"
                yield from others
        else:
            yield f"{indent}{key}: {_inline(value)}"


def _inline(value: object) -> str:
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, list):
        return f"[{', '.join(_inline(one) for one in value)}]"
    return json.dumps(value)


def _text(value: str) -> str:
    """Return a text in quotes, as YAML escapes: other than in JSON a character beyond 16 bits is one escape."""
    return '"' + "".join(one if one in _PLAIN else _escape(ord(one)) for one in value) + '"'


def _escape(code: int) -> str:
    if 0xD800 <= code < 0xE000:
        return "\\ufffd"
    return f"\\x{code:02x}" if code < 1 << 8 else f"\\u{code:04x}" if code < 1 << 16 else f"\\U{code:08x}"
