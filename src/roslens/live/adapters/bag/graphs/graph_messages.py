"""The graph in a recording of ROS 2, if it was published, as by graph-monitor.

The fields are those of rosgraph_msgs in rcl_interfaces, and of its forerunner rosgraph_monitor_msgs in graph-monitor.
Such a message says who publishes, takes and serves what at one instant; nothing else in a recording of ROS 2 does.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import msgspec

from roslens.live.adapters.bag.block import Part
from roslens.live.adapters.bag.channel import Channel, resolved
from roslens.live.adapters.bag.damage import DamageError
from roslens.live.adapters.bag.field_reader import MessageReader
from roslens.live.reported.parameter_text import value_text
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.qos import Qos

TYPES = frozenset({"rosgraph_msgs/msg/Graph", "rosgraph_monitor_msgs/msg/Graph"})
MOST_MESSAGES = 10_000
"""Messages of a recording that are read; the graph changes seldom, and who publishes it more often is cut short."""
_SECOND = 1_000_000_000
_ENDS = {
    "publishers": Role.PUBLISHER,
    "subscriptions": Role.SUBSCRIPTION,
    "service_clients": Role.SERVICE_CLIENT,
    "service_servers": Role.SERVICE_SERVER,
    "action_clients": Role.ACTION_CLIENT,
    "action_servers": Role.ACTION_SERVER,
}
_OF_TOPICS = (Role.PUBLISHER, Role.SUBSCRIPTION)
_HISTORY = {1: "keep_last", 2: "keep_all"}
_DURABILITY = {1: "transient_local", 2: "volatile"}
_LIVELINESS = {1: "automatic", 3: "manual_by_topic"}
# The two messages number it differently.
_RELIABILITY = {
    "rosgraph_msgs/msg/Graph": {1: "reliable", 2: "best_effort"},
    "rosgraph_monitor_msgs/msg/Graph": {1: "best_effort", 2: "reliable"},
}
_VALUES = (
    "bool_value", "integer_value", "double_value", "string_value", "byte_array_value", "bool_array_value",
    "integer_array_value", "double_array_value", "string_array_value",
)  # fmt: skip
"""The field of a parameter's value, by its type less one (rcl_interfaces, ParameterType)."""


def graphs_of(parts: Sequence[Part]) -> list[tuple[float, Graph]]:
    """Return the graphs that files hold, by the second of receipt; equal ones that follow each other once.

    What cannot be decoded is left out and reported in the failures of its file.
    """
    found: list[tuple[float, Graph]] = []
    for part in parts:
        readers = _readers(part)
        if readers:
            found += _read(part, readers)
    found.sort(key=lambda one: one[0])
    return [one for place, one in enumerate(found) if not place or found[place - 1][1] != one[1]]


def _readers(part: Part) -> dict[int, MessageReader]:
    readers = {}
    for number, channel in part.channels.items():
        if channel.type in TYPES:
            try:
                readers[number] = MessageReader(channel)
            except DamageError as damage:
                part.failures.add(part.path, f'"{channel.topic}" has {damage}', advice="Its graph is left out.")
    return readers


def _read(part: Part, readers: Mapping[int, MessageReader]) -> Iterator[tuple[float, Graph]]:
    left = MOST_MESSAGES
    for load in part.loads(readers.keys()):
        for message in load.read():
            channel = part.channels[message.channel]
            if not left:
                what = f'"{channel.topic}" has more than {MOST_MESSAGES:,} graphs'
                part.failures.add(part.path, what, advice="Later ones are left out.")
                return
            left -= 1
            try:
                yield message.time / _SECOND, graph_of_message(readers[message.channel].read(message), channel.type)
            except (DamageError, AttributeError, TypeError, ValueError) as damage:
                what = f'"{channel.topic}" has a graph that cannot be read: {damage}'
                part.failures.add(part.path, what, advice="It is left out.")


def graph_of_message(message: Any, type_: str) -> Graph:
    """Return a decoded message of one of :data:`TYPES` as a graph.

    Raises:
        AttributeError, TypeError, ValueError: it has not the fields of one.
    """
    names: set[str] = set()
    endpoints: set[Endpoint] = set()
    parameters: dict[str, dict[str, str]] = {}
    for node in message.nodes:
        name = resolved(str(node.name))
        if not name:
            continue
        names.add(name)
        endpoints.update(_ends(name, node, _RELIABILITY[type_]))
        values = getattr(node, "parameter_values", ())
        if len(values) and len(values) == len(node.parameters):
            pairs = zip(node.parameters, values, strict=True)
            texts = ((str(one.name), _value(str(one.name), value)) for one, value in pairs)
            parameters[name] = {key: text for key, text in texts if text}
    nodes = tuple(Node(name) for name in sorted(names))
    return Graph("ros2", nodes, tuple(sorted(endpoints, key=_order)), parameters=dict(sorted(parameters.items())))


def _order(end: Endpoint) -> tuple[str, str, str, str, str]:
    return end.node, end.role.value, end.name, end.type, repr(end.qos)


def _ends(node: str, message: Any, reliability: Mapping[int, str]) -> Iterator[Endpoint]:
    for field, role in _ENDS.items():
        for one in getattr(message, field, ()):
            if role in _OF_TOPICS:
                type_, digest = _type(one.type)
                yield Endpoint(node, role, str(one.name), type_, digest, _qos(one.qos, reliability))
            else:
                type_, _ = _type(one.request_type)
                yield Endpoint(node, role, str(one.name), type_.rpartition("_")[0])


def _type(described: Any) -> tuple[str, str]:
    if isinstance(described, str):
        return described, ""
    value = bytes(described.hash.value)
    return str(described.name), f"RIHS{int(described.hash.version):02d}_{value.hex()}" if any(value) else ""


def _qos(qos: Any, reliability: Mapping[int, str]) -> Qos | None:
    known = Qos(
        reliability.get(int(qos.reliability), ""), _DURABILITY.get(int(qos.durability), ""),
        _HISTORY.get(int(qos.history), ""), int(qos.depth), _seconds(qos.deadline), _seconds(qos.lifespan),
        _LIVELINESS.get(int(qos.liveliness), ""), _seconds(qos.liveliness_lease_duration),
    )  # fmt: skip
    return known if known != Qos() else None


def _seconds(duration: Any) -> float:
    # Middlewares write "no limit" as the largest time they know.
    return 0.0 if duration.sec >= 2**31 - 1 else float(duration.sec + duration.nanosec * 1e-9)


def _value(name: str, value: Any) -> str:
    """Return the value of a parameter as text, empty where it has none."""
    place = int(value.type) - 1
    if not 0 <= place < len(_VALUES):
        return ""
    held = getattr(value, _VALUES[place])
    return value_text(name, held.tolist() if hasattr(held, "tolist") else held)


def sole_publishers(graphs: Iterable[tuple[float, Graph]]) -> dict[str, str]:
    """Return for each topic that one node alone ever published by these graphs that node: its traffic is all of it."""
    known: dict[str, set[str]] = {}
    for _, graph in graphs:
        for end in graph.endpoints:
            if end.role is Role.PUBLISHER:
                known.setdefault(end.name, set()).add(end.node)
    return {topic: next(iter(nodes)) for topic, nodes in known.items() if len(nodes) == 1}


def named(channels: Mapping[int, Channel], publishers: Mapping[str, str]) -> dict[int, Channel]:
    """Return channels, those without a publisher with that which is known of their topic."""
    return {
        number: channel
        if channel.publisher
        else msgspec.structs.replace(channel, publisher=publishers.get(channel.topic, ""))
        for number, channel in channels.items()
    }
