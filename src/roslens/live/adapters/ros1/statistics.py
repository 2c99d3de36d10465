"""``/statistics``, in which subscribers report what they received, as tallies."""

from __future__ import annotations

import struct

from roslens.model.traffic.tally import NOTHING, Moments, Observer, Tally

TOPIC = "/statistics"
LARGEST = 65_536
_TAIL = struct.Struct("<IIIIiii12i")
_LONGEST_NAME = 4096


class StatisticsError(ValueError):
    """Bytes that are no rosgraph_msgs/TopicStatistics."""


def read_statistics(body: bytes, received: float, host: str = "") -> Tally:
    """Read a serialised rosgraph_msgs/TopicStatistics.

    Nothing is sent while no message comes, and windows of slow topics stretch to a minute: the stretch ends when the
    statistics were ``received``, in seconds on the observer's clock, and is as long as they say, for their own instants
    may be of simulated time. Bytes hold what the subscriber counts: rospy adds 4 for each message. The least period is
    not reported; the mean stands for it. A topic without a header tells an age of 0 and neither age nor loss are known.

    A time between messages belongs to the message that ends it. Nodes started through roslens tell it of each; the
    loggers of ROS leave that of the first message of a stretch out, for which the mean of the others stands. Without
    it, a stretch with few messages would weigh less than one with many, and a rate that drops be noticed late.

    Raises:
        StatisticsError: the bytes are none.
    """
    names, place = [], 0
    for _ in range(3):
        size = int.from_bytes(body[place : place + 4], "little")
        if size > _LONGEST_NAME or place + 4 + size > len(body):
            raise StatisticsError(f"a name of {size:,} bytes in statistics of {len(body):,} bytes")
        names.append(body[place + 4 : place + 4 + size].decode(errors="replace"))
        place += 4 + size
    if len(body) - place != _TAIL.size:
        raise StatisticsError(f"{len(body) - place} bytes after the names, expected {_TAIL.size}")
    start_s, start_ns, stop_s, stop_ns, delivered, dropped, traffic, *times = _TAIL.unpack_from(body, place)
    seconds = [times[i] + times[i + 1] * 1e-9 for i in range(0, 12, 2)]
    length = (stop_s - start_s) + (stop_ns - start_ns) * 1e-9
    if delivered < 0 or not 0 <= length <= 3600:
        raise StatisticsError(f"{delivered} messages in {length:g} s, expected neither to be negative")
    age = _moments(delivered, *seconds[3:6])
    aged = any(seconds[3:6])
    return Tally(
        names[0], names[1], names[2], received - length, received, delivered,
        traffic if traffic >= 0 else -1,
        period=_moments(delivered, *seconds[:3]) if seconds[0] > 0 else NOTHING,
        age=age if aged else NOTHING,
        lost=dropped if aged and dropped >= 0 else -1,
        observer=Observer.INSIDE,
        host=host,
    )  # fmt: skip


def _moments(count: int, mean: float, deviation: float, greatest: float) -> Moments:
    if count <= 0:
        return NOTHING
    squares = (deviation * deviation + mean * mean) * count
    return Moments(count, mean * count, squares, min(mean, greatest), max(mean, greatest))
