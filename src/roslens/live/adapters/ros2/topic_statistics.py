"""Topic statistics of rclcpp, as tallies.

A C++ subscription with ``topic_stats_options`` tells once a window, in two statistics_msgs/MetricsMessage on
``/statistics``:

- ``message_period``: times between its messages; the number of samples is that of messages, but for the very first.
- ``message_age``: from the stamp in the header to receipt; NaN where messages have no header. By the clocks of two
  hosts, so it may be negative.

Both are in milliseconds, with average, least, greatest, standard deviation and number of samples. What they do not say:

- the topic. ``measurement_source_name`` is the node, without its namespace. Where that node subscribes to one topic
  only, it is that one; otherwise what is reported cannot be said of any topic, and is left out with a word about it.
- the publisher. Where the topic has one, it is that one.
- sizes and losses.
"""

from __future__ import annotations

import math
from typing import Any

from roslens.live.adapters.ros2 import TOOL
from roslens.model.failure import Failure
from roslens.model.graph import Graph, Role
from roslens.model.traffic.tally import NOTHING, Moments, Observer, Tally

TOPIC = "/statistics"
TYPE = "statistics_msgs/msg/MetricsMessage"
_AVERAGE, _LEAST, _GREATEST, _DEVIATION, _COUNT = range(1, 6)
_PERIOD, _AGE = "message_period", "message_age"
_UNITS = {"ms": 1e-3, "us": 1e-6, "ns": 1e-9, "s": 1.0}
_BESIDES = ("/parameter_events", "/clock", "/rosout")
"""What nodes subscribe to without measuring it."""
_LONGEST_S = 3600.0
_MOST_AGES = 10_000


class TopicStatistics:
    """Joins ages and periods of the same window, and finds the topic they are about."""

    def __init__(self, host: str) -> None:
        self._host = host
        self._subscribed: dict[str, set[str]] = {}
        self._publishers: dict[str, set[str]] = {}
        self._ages: dict[tuple[str, float], Moments] = {}
        self._reported: set[str] = set()
        self._failures: list[Failure] = []

    def choose(self, graph: Graph) -> None:
        """Take note of who subscribes to what."""
        self._subscribed, self._publishers = {}, {}
        for end in graph.endpoints:
            if end.role is Role.SUBSCRIPTION and end.name not in _BESIDES and "/_action/" not in end.name:
                self._subscribed.setdefault(end.node, set()).add(end.name)
            elif end.role is Role.PUBLISHER:
                self._publishers.setdefault(end.name, set()).add(end.node)

    def take(self, message: Any, gid: str, node: str | None, received: float) -> Tally | None:
        """Return the tally that a message completes; None where there is none.

        Args:
            message: a statistics_msgs/MetricsMessage.
            gid: of its publisher, by which two subscriptions of one node differ.
            node: that publishes it; None where unknown.
            received: seconds since the epoch.
        """
        scale = _UNITS.get(message.unit)
        length = _seconds(message.window_stop) - _seconds(message.window_start)
        if scale is None or message.metrics_source not in (_PERIOD, _AGE) or not 0 <= length <= _LONGEST_S:
            self._fail(
                f"statistics of {message.measurement_source_name[:80]!r} about {message.metrics_source[:40]!r} in "
                f"{message.unit[:10]!r} over {length:g} s",
                f"{_PERIOD} or {_AGE} in ms over less than an hour", "",
            )  # fmt: skip
            return None
        moments = moments_of(message.statistics, scale)
        key = (gid, _seconds(message.window_stop))
        if message.metrics_source == _AGE:
            # The one about periods follows it.
            if len(self._ages) >= _MOST_AGES:
                self._ages.clear()
            self._ages[key] = moments
            return None
        age = self._ages.pop(key, NOTHING)
        topic = self._topic_of(node, message.measurement_source_name)
        if topic is None:
            return None
        publishers = self._publishers.get(topic, set())
        return Tally(
            topic, next(iter(publishers)) if len(publishers) == 1 else "", node or "", received - length, received,
            max(moments.count, age.count), period=moments, age=age, observer=Observer.PROTOCOL, host=self._host,
        )  # fmt: skip

    def _topic_of(self, node: str | None, name: str) -> str | None:
        topics = sorted(self._subscribed.get(node or "", ()))
        if node and len(topics) == 1:
            return topics[0]
        who = node or name[:80]
        what = f"{who} reports statistics of a subscription without naming its topic"
        expected = f"one subscription of {who}"
        if topics:
            expected += f"; it has {len(topics)}: {', '.join(topics[:5])}{', …' if len(topics) > 5 else ''}"
        self._fail(what, expected, "Start it through `roslens run`, which counts every topic", who)
        return None

    def _fail(self, what: str, expected: str, advice: str, who: str = "") -> None:
        if what not in self._reported and len(self._reported) < 100:
            self._reported.add(what)
            entity = f"node:{who}" if who.startswith("/") else ""
            self._failures.append(Failure(TOOL, what, expected, advice, entity=entity, partial=True))

    def failures(self) -> list[Failure]:
        """Return what could not be used since this was last asked."""
        failures, self._failures = self._failures, []
        return failures


def moments_of(points: Any, scale: float) -> Moments:
    """Return the moments of statistics_msgs/StatisticDataPoint; those of nothing where a part of them is missing."""
    found = {point.data_type: point.data for point in points}
    mean, least, greatest, deviation, number = (
        found.get(kind, math.nan) for kind in (_AVERAGE, _LEAST, _GREATEST, _DEVIATION, _COUNT)
    )
    count = int(number) if 0 < number < 2**53 else 0
    if not count or not all(map(math.isfinite, (mean, least, greatest, deviation))):
        return NOTHING
    mean, least, greatest, deviation = (value * scale for value in (mean, least, greatest, deviation))
    return Moments(count, mean * count, (deviation**2 + mean**2) * count, least, greatest)


def _seconds(time: Any) -> float:
    return float(time.sec) + 1e-9 * float(time.nanosec)
