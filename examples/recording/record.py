"""Writes a recording of the example rover with one fault, for `roslens serve --bag` and `roslens watch --bag`.

    python examples/recording/record.py rover_drive
    python examples/recording/record.py rover_drive --healthy     without the fault

/range_filter says /scan at 10 Hz, /rover_base /odom at 20 Hz, /battery_monitor /battery at 1 Hz, /rover_follower
/cmd_vel at 20 Hz. At 40 s the range filter begins to say a quarter of its scans, and goes on like that until the end at
60 s: the follower then steers by what is long past. The nodes are those of `examples/workspace`.

It is written as rosbag2 writes: a folder with an MCAP file, in it /rosgraph of a graph monitor, which says who is there
(`rover_graph.py`). The rover that was driven is not quite that of the source: see there.
"""

import random
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy
from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag2 import StoragePlugin, Writer
from rover_graph import JOYSTICK_S, graph, store

STORE = store()
LENGTH_S = 60.0
FAULT_S = 40.0
START_NS = 1_700_000_000_000_000_000


def moments(hertz: float, jitter_s: float, seed: int) -> Iterator[float]:
    """Yield when messages come."""
    rng = random.Random(seed)
    for number in range(1, int(LENGTH_S * hertz)):
        yield number / hertz + rng.uniform(0, jitter_s)


def scan_times(healthy: bool) -> Iterator[float]:
    """10 Hz, with a fault a quarter of that from 40 s on."""
    for number, time in enumerate(moments(10, 0.004, 1)):
        if healthy or time < FAULT_S or number % 4 == 0:
            yield time


def header(time: float, frame: str) -> Any:
    """Return a header whose stamp is 3 ms before receipt."""
    stamp = START_NS + int((time - 0.003) * 1e9)
    kind = STORE.types["builtin_interfaces/msg/Time"]
    return STORE.types["std_msgs/msg/Header"](kind(stamp // 10**9, stamp % 10**9), frame)


def scan(time: float) -> Any:
    """Return one distance for each of four sonars."""
    ranges = numpy.full(4, 2.5, dtype=numpy.float32)
    empty = numpy.zeros(0, dtype=numpy.float32)
    return STORE.types["sensor_msgs/msg/LaserScan"](
        header(time, "base_link"), 0.0, 4.71, 1.57, 0.0, 0.0, 0.02, 4.0, ranges, empty
    )


def vector(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Any:
    """Return a vector."""
    return STORE.types["geometry_msgs/msg/Vector3"](x, y, z)


def odometry(time: float) -> Any:
    """Return a rover that drives straight on at 0.5 m/s."""
    types, nothing = STORE.types, numpy.zeros(36)
    point = types["geometry_msgs/msg/Point"](0.5 * time, 0.0, 0.0)
    pose = types["geometry_msgs/msg/Pose"](point, types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0))
    twist = types["geometry_msgs/msg/Twist"](vector(0.5), vector())
    return types["nav_msgs/msg/Odometry"](
        header(time, "odom"), "base_link", types["geometry_msgs/msg/PoseWithCovariance"](pose, nothing),
        types["geometry_msgs/msg/TwistWithCovariance"](twist, nothing),
    )  # fmt: skip


def battery(time: float) -> Any:
    """Return a level that falls."""
    empty = numpy.zeros(0, dtype=numpy.float32)
    return STORE.types["sensor_msgs/msg/BatteryState"](
        header(time, ""), 25.2, 20.0, -2.0, 4.5, 5.0, 5.0, 0.9 - 0.001 * time, 2, 1, 2, True, empty, empty, "", ""
    )


def velocity(time: float) -> Any:
    """Return a slow drive straight on."""
    return STORE.types["geometry_msgs/msg/Twist"](vector(0.5), vector())


def profile(reliability: QosReliability, durability: QosDurability, depth: int) -> Qos:
    """Return what a publisher offers."""
    never = QosTime(0, 0)
    return Qos(
        QosHistory.KEEP_LAST, depth, reliability, durability, never, never, QosLiveliness.AUTOMATIC, never, False
    )


RELIABLE = profile(QosReliability.RELIABLE, QosDurability.VOLATILE, 10)
SENSOR = profile(QosReliability.BEST_EFFORT, QosDurability.VOLATILE, 5)
KEPT = profile(QosReliability.RELIABLE, QosDurability.TRANSIENT_LOCAL, 1)


def main() -> int:
    """Write the recording."""
    given = [argument for argument in sys.argv[1:] if argument != "--healthy"]
    healthy = "--healthy" in sys.argv
    path = Path(given[0] if given else "rover_drive")
    if (path / "metadata.yaml").exists():
        shutil.rmtree(path)
    parts = [
        ("/scan", "sensor_msgs/msg/LaserScan", SENSOR, scan, scan_times(healthy)),
        ("/odom", "nav_msgs/msg/Odometry", RELIABLE, odometry, moments(20, 0.002, 2)),
        ("/battery", "sensor_msgs/msg/BatteryState", RELIABLE, battery, moments(1, 0.01, 3)),
        ("/cmd_vel", "geometry_msgs/msg/Twist", RELIABLE, velocity, moments(20, 0.003, 4)),
        ("/rosgraph", "rosgraph_msgs/msg/Graph", KEPT, graph, iter((0.02, JOYSTICK_S))),
    ]
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as bag:
        messages = []
        for topic, kind, offered, made, times in parts:
            connection = bag.add_connection(topic, kind, typestore=STORE, offered_qos_profiles=[offered])
            messages += [(time, topic, connection, kind, made(time)) for time in times]
        for time, _, connection, kind, message in sorted(messages, key=lambda one: one[:2]):
            bag.write(connection, START_NS + int(time * 1e9), bytes(STORE.serialize_cdr(message, kind)))
    print(f"{path}: {len(messages):,} messages in {LENGTH_S:g} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
