"""Statistics of what a rospy node receives, counted at a seventh of what rospy's own logger takes.

Takes the place of ``rospy.impl.statistics.SubscriberStatisticsLogger`` behind the same topic, ``/statistics``, and the
same message, so that whoever reads it need not know. Differences: a message costs the same however many came; what is
reported is reported by a timer, so silence is reported too, once a second, and windows never stretch; a gap of sequence
numbers counts all messages in it; the gap before the first message of a window belongs to that window.

Runs inside the user's node: in any Python from 3.8 on, with nothing but the standard library and rospy.
"""

from __future__ import annotations

import os
import sys
import threading
import time
from types import ModuleType
from typing import Any

from .when_imported import when_imported

TOPIC = "/statistics"
PERIOD_S = 0.15
SWITCH = "ROSLENS_ROS1_STATISTICS"
"""Environment variable that keeps rospy's own logger where it is ``0``."""
_LEFT_OUT = ("/clock", TOPIC)
_INT32 = 2**31 - 1
_EXPECTED = ("is_enabled", "callback", "shutdown")


def install() -> None:
    """Take the logger's place as soon as rospy is imported, if rospy is as expected then."""
    when_imported("rospy.topics", hook_topics)


def hook_topics(module: ModuleType) -> None:
    """Take the logger's place in ``rospy.topics``; leave everything as it is where that is not as expected."""
    logger = getattr(module, "SubscriberStatisticsLogger", None)
    if os.environ.get(SWITCH) == "0" or not hasattr(module, "_SubscriberImpl"):
        return
    if isinstance(logger, type) and all(callable(getattr(logger, name, None)) for name in _EXPECTED):
        module.SubscriberStatisticsLogger = LightLogger  # type: ignore[attr-defined]


class Connection:
    """Sums over all messages of one publisher since the connection exists; whoever reads takes differences."""

    __slots__ = (
        "aged",
        "ages",
        "count",
        "gaps",
        "intervals",
        "last",
        "longest",
        "lost",
        "oldest",
        "sequence",
        "size",
        "square_ages",
        "square_gaps",
    )  # fmt: skip

    def __init__(self) -> None:
        self.count = self.intervals = self.aged = self.lost = self.size = 0
        self.last = self.gaps = self.square_gaps = self.longest = self.ages = self.square_ages = 0.0
        self.oldest = float("-inf")
        self.sequence = -1

    def sums(self) -> tuple[float, ...]:
        """Return what only grows."""
        return (self.count, self.size, self.lost, self.intervals, self.gaps, self.square_gaps, self.aged, self.ages,
                self.square_ages)  # fmt: skip


class LightLogger:
    """What rospy's logger is to rospy: made for each subscriber, called with each message."""

    def __init__(self, subscriber: Any) -> None:
        self.topic = subscriber.name
        self.connections: dict[str, Connection] = {}
        self._subscriber = subscriber
        self._reported: dict[str, tuple[float, ...]] = {}
        if self.topic in _LEFT_OUT:
            self.callback = self._ignore  # type: ignore[method-assign]
        else:
            _TELLER.add(self)

    @classmethod
    def is_enabled(cls) -> bool:
        """Always true: this is installed only if it is wanted."""
        return True

    def _ignore(self, msg: Any, publisher: str, stat_bytes: int) -> None:
        pass

    def callback(self, msg: Any, publisher: str, stat_bytes: int) -> None:
        """Count a message; ``stat_bytes`` is what the connection carried since it exists."""
        try:
            self._count(msg, publisher, stat_bytes)
        except Exception as error:  # noqa: BLE001 - a node must run whatever becomes of its observer
            self.callback = self._ignore  # type: ignore[method-assign]
            sys.stderr.write("roslens: %s is no longer counted: %s\n" % (self.topic, error))  # noqa: UP031

    def _count(self, msg: Any, publisher: str, stat_bytes: int) -> None:
        now = _TELLER.clock()
        seen = self.connections.get(publisher)
        if seen is None:
            seen = self.connections[publisher] = Connection()
            self._reported[publisher] = (0, stat_bytes, 0, 0, 0.0, 0.0, 0, 0.0, 0.0)
        gap = now - seen.last
        if seen.count and gap >= 0:
            seen.intervals += 1
            seen.gaps += gap
            seen.square_gaps += gap * gap
            if gap > seen.longest:
                seen.longest = gap
        seen.last = now
        seen.count += 1
        seen.size = stat_bytes
        if msg._has_header:  # noqa: SLF001 - generated into every message
            header = msg.header
            stamp = header.stamp
            age = now - stamp.secs - stamp.nsecs * 1e-9
            seen.aged += 1
            seen.ages += age
            seen.square_ages += age * age
            if age > seen.oldest:
                seen.oldest = age
            sequence = header.seq
            if sequence > seen.sequence + 1 and seen.sequence >= 0:
                seen.lost += sequence - seen.sequence - 1
            seen.sequence = sequence

    def windows(self) -> list[tuple[str, list[float], float, float]]:
        """Return publishers, growth of their sums, longest gaps and greatest ages; forget who is gone."""
        found = []
        there = self._publishers()
        for publisher, seen in list(self.connections.items()):
            sums = seen.sums()
            before = self._reported.get(publisher, (0.0,) * len(sums))
            self._reported[publisher] = sums
            longest, seen.longest = seen.longest, 0.0
            oldest, seen.oldest = seen.oldest, float("-inf")
            found.append((publisher, [new - old for new, old in zip(sums, before)], longest, oldest))  # noqa: B905
            if sums[0] == before[0] and publisher not in there:
                self.connections.pop(publisher, None)
                self._reported.pop(publisher, None)
        return found

    def _publishers(self) -> set[str]:
        connections = getattr(self._subscriber, "connections", None) or ()
        return {getattr(connection, "callerid_pub", "") for connection in list(connections)}

    def shutdown(self) -> None:
        """Forget everything: the subscriber is closed."""
        _TELLER.discard(self)
        self.connections.clear()


class Teller:
    """Publishes what the loggers of this process counted, once a period, from a thread of its own.

    Attributes:
        clock: time of ROS in seconds, as cheap as it can be had.
    """

    def __init__(self) -> None:
        self.clock = time.time
        self._loggers: set[LightLogger] = set()
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._publisher: Any = None
        self._since = 0.0

    def add(self, logger: LightLogger) -> None:
        """Report a logger from now on."""
        with self._lock:
            self._loggers.add(logger)
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, daemon=True, name="roslens-statistics")
                self._thread.start()

    def discard(self, logger: LightLogger) -> None:
        """Stop reporting it."""
        with self._lock:
            self._loggers.discard(logger)

    def _run(self) -> None:
        rest = threading.Event()
        try:
            while True:
                rest.wait(PERIOD_S)
                if self._ended():
                    return
                self._tell()
        except Exception as error:  # noqa: BLE001 - a node must run whatever becomes of its observer
            sys.stderr.write("roslens: the traffic of this node is no longer reported: %s\n" % error)  # noqa: UP031

    @staticmethod
    def _ended() -> bool:
        import rospy  # type: ignore[import-not-found]

        return bool(rospy.core.is_shutdown_requested())

    def _tell(self) -> None:
        import rospy

        if not rospy.core.is_initialized() or not rospy.rostime.is_rostime_initialized():
            return
        self.clock = time.time if rospy.rostime.is_wallclock() else rospy.get_time
        now = self.clock()
        if self._publisher is None:
            from rosgraph_msgs.msg import TopicStatistics  # type: ignore[import-not-found]

            self._publisher = rospy.Publisher(TOPIC, TopicStatistics, queue_size=100)
        since, self._since = self._since, now
        with self._lock:
            loggers = list(self._loggers)
        node = rospy.get_name()
        for logger in loggers:
            for window in logger.windows():
                if 0 < since <= now:
                    self._publisher.publish(_message(logger.topic, node, since, now, *window))


def _message(
    topic: str, node: str, since: float, now: float, publisher: str, grown: list[float], longest: float, oldest: float
) -> Any:
    import rospy
    from rosgraph_msgs.msg import TopicStatistics

    count, size, lost, intervals, gaps, square_gaps, aged, ages, square_ages = grown
    message = TopicStatistics(topic=topic, node_pub=publisher, node_sub=node)
    message.window_start, message.window_stop = rospy.Time.from_sec(since), rospy.Time.from_sec(now)
    message.delivered_msgs = min(int(count), _INT32)
    message.dropped_msgs = min(max(int(lost), 0), _INT32)
    message.traffic = min(max(int(size), 0), _INT32)
    period = _three(intervals, gaps, square_gaps, longest)
    message.period_mean, message.period_stddev, message.period_max = map(rospy.Duration.from_sec, period)
    age = _three(aged, ages, square_ages, oldest)
    message.stamp_age_mean, message.stamp_age_stddev, message.stamp_age_max = map(rospy.Duration.from_sec, age)
    return message


def _three(count: float, total: float, squares: float, greatest: float) -> tuple[float, float, float]:
    """Return mean, deviation and greatest, as durations of ROS hold them."""
    if count <= 0:
        return 0.0, 0.0, 0.0
    mean = total / count
    deviation = max(squares / count - mean * mean, 0.0) ** 0.5
    limit = float(_INT32)
    return (
        min(max(mean, -limit), limit),
        min(deviation, limit),
        min(max(greatest, mean, -limit), limit),
    )


_TELLER = Teller()
