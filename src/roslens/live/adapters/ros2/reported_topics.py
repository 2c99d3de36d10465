"""What nodes and monitors report about themselves on topics: changes of parameters, diagnostics, statistics.

Own subscriptions, opened only where somebody publishes, and emptied once a period without an executor.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator
from typing import Any

import msgspec

from roslens.live.adapters.ros2 import TOOL, topic_statistics
from roslens.live.adapters.ros2.parameters import EVENTS, Parameters, value_of
from roslens.live.adapters.ros2.topic_statistics import TopicStatistics
from roslens.live.reported.diagnostic_array import ArrayError, read_array
from roslens.live.reported.parameter_text import value_text
from roslens.live.reported.reported_levels import TOPIC as DIAGNOSTICS
from roslens.live.reported.reported_levels import ReportedLevels
from roslens.model.failure import Failure
from roslens.model.graph import Event, Graph, Role
from roslens.model.traffic.tally import Tally

_TYPES = {
    EVENTS: "rcl_interfaces/msg/ParameterEvent",
    DIAGNOSTICS: "diagnostic_msgs/msg/DiagnosticArray",
    topic_statistics.TOPIC: topic_statistics.TYPE,
}
_RAW = (DIAGNOSTICS,)
DEPTH = 1000
"""Messages that wait for the end of a period; the middleware drops what is more."""


class Reported(msgspec.Struct):
    """What was reported since the last time."""

    tallies: list[Tally] = []
    events: list[Event] = []
    failures: list[Failure] = []


class ReportedTopics:
    """Listens.

    Args:
        node: of rclpy.
        host: the name of this host.
        parameters: of all nodes.
    """

    def __init__(self, node: Any, host: str, parameters: Parameters) -> None:
        self.parameters = parameters
        self._node = node
        self._levels = ReportedLevels()
        self._statistics = TopicStatistics(host)
        self._open: dict[str, Any] = {}
        self._refused: set[str] = set()
        self._odd: set[str | None] = set()
        self._failures: list[Failure] = []

    def choose(self, graph: Graph) -> None:
        """Subscribe to topics that have a publisher."""
        self.parameters.follow(graph)
        spoken = {
            end.name for end in graph.endpoints if end.role is Role.PUBLISHER and _TYPES.get(end.name) == end.type
        }
        if topic_statistics.TOPIC in spoken:
            self._statistics.choose(graph)
        for topic in self._open.keys() - spoken:
            self._node.destroy_subscription(self._open.pop(topic))
        for topic in sorted(spoken - self._open.keys() - self._refused):
            self._subscribe(topic, graph)

    def _subscribe(self, topic: str, graph: Graph) -> None:
        from rclpy.qos import QoSProfile, QoSReliabilityPolicy

        offered = [end.qos for end in graph.endpoints if end.role is Role.PUBLISHER and end.name == topic]
        reliable = all(qos is not None and qos.reliability == "reliable" for qos in offered)
        policy = QoSReliabilityPolicy.RELIABLE if reliable else QoSReliabilityPolicy.BEST_EFFORT
        package, _, kind = _TYPES[topic].partition("/msg/")
        try:
            message = getattr(importlib.import_module(f"{package}.msg"), kind)
            self._open[topic] = self._node.create_subscription(
                message, topic, _nothing, QoSProfile(depth=DEPTH, reliability=policy), raw=topic in _RAW
            )
        except Exception as error:  # noqa: BLE001 - what a type's support raises is anything
            self._refused.add(topic)
            self._failures.append(
                Failure(
                    TOOL, f"{topic} cannot be read: {type(error).__name__}: {error}",
                    f"the messages of {package} in the Python of the observer",
                    "Source the workspace that has them before roslens starts", entity=f"topic:{topic}", partial=True,
                )
            )  # fmt: skip

    def take(self, now: float, node_of: Callable[[str], str | None]) -> Reported:
        """Return what came until ``now``, seconds since the epoch."""
        fresh = Reported()
        for topic in sorted(self._open):
            for message, gid, time in self._messages(topic, now):
                if topic == EVENTS:
                    self._parameter_event(message, time)
                elif topic == DIAGNOSTICS:
                    fresh.events += self._diagnostics(message, node_of(gid), time)
                elif tally := self._statistics.take(message, gid, node_of(gid), time):
                    fresh.tallies.append(tally)
        fresh.events += self.parameters.events(now)
        fresh.failures += [*self._failures, *self._statistics.failures(), *self.parameters.failures()]
        self._failures.clear()
        return fresh

    def _messages(self, topic: str, now: float) -> Iterator[tuple[Any, str, float]]:
        subscription = self._open[topic]
        for _ in range(DEPTH):
            taken = subscription.handle.take_message(subscription.msg_type, topic in _RAW)
            if taken is None:
                return
            message, info = taken
            gid = bytes((info.get("publisher_gid") or {"data": b""})["data"])
            yield message, gid[:16].hex(), min(now, info["received_timestamp"] * 1e-9 or now)

    def _parameter_event(self, event: Any, time: float) -> None:
        values = {
            one.name: value_text(one.name, value_of(one.value))
            for one in (*event.new_parameters, *event.changed_parameters)
        }
        self.parameters.note(event.node, values, [one.name for one in event.deleted_parameters], time)

    def _diagnostics(self, body: bytes, node: str | None, time: float) -> list[Event]:
        try:
            return self._levels.take(node or "", read_array(bytes(body), cdr=True), time)
        except ArrayError as error:
            if node not in self._odd:
                self._odd.add(node)
                what = f"diagnostics of {node or 'an unknown node'} cannot be decoded: {error}"
                expected, entity = _TYPES[DIAGNOSTICS], f"topic:{DIAGNOSTICS}"
                self._failures.append(Failure(TOOL, what, expected, entity=entity, partial=True))
            return []

    def close(self) -> None:
        """Listen no more."""
        self.parameters.close()
        for topic in list(self._open):
            self._node.destroy_subscription(self._open.pop(topic))


def _nothing(_: object) -> None:
    """Never called: the node is not spun."""
