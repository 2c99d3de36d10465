"""Writes a recording of a small robot with three nodes and three faults, for `roslens watch --bag`.

    python examples/robot/record.py robot.bag
    python examples/robot/record.py robot.bag --healthy     without the faults, for `roslens reference mutate`

/lidar says /scan at 25 Hz, /odometry says /odom at 50 Hz, /planner says /cmd_vel at 20 Hz and /planner/status every
3.3 s. At 30 s the lidar slows down to 10 Hz for six seconds; at 45 s the odometry is silent for 0.3 s; at 60 s the
planner stops for good, 20 s before the end.
"""

import random
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore

STORE = get_typestore(Stores.ROS1_NOETIC)
LENGTH_S = 80.0
START_NS = 1_700_000_000_000_000_000


def moments(hertz: float, jitter_s: float, seed: int, until: float = LENGTH_S) -> Iterator[float]:
    """Yield when messages come."""
    rng = random.Random(seed)
    for number in range(1, int(until * hertz)):
        yield number / hertz + rng.uniform(0, jitter_s)


def scan_times() -> Iterator[float]:
    """25 Hz, but 10 Hz from 30 s to 36 s."""
    kept = 0.0
    for time in moments(25, 0.002, 1):
        if not 30 <= time < 36 or time - kept >= 0.099:
            kept = time
            yield time


def odometry_times() -> Iterator[float]:
    """50 Hz, with a gap from 45 s to 45.3 s."""
    return (time for time in moments(50, 0.001, 2) if not 45 <= time < 45.3)


def header(number: int, time: float, frame: str) -> Any:
    """Return a header whose stamp is 4 ms before receipt."""
    stamp = START_NS + int((time - 0.004) * 1e9)
    kind = STORE.types["builtin_interfaces/msg/Time"]
    return STORE.types["std_msgs/msg/Header"](number, kind(stamp // 10**9, stamp % 10**9), frame)


def scan(number: int, time: float) -> Any:
    """Return 90 distances in a round room."""
    ranges = numpy.full(90, 4.0, dtype=numpy.float32)
    empty = numpy.zeros(0, dtype=numpy.float32)
    return STORE.types["sensor_msgs/msg/LaserScan"](
        header(number, time, "laser"), -1.57, 1.57, 0.035, 0.0, 0.04, 0.1, 10.0, ranges, empty
    )


def imu(number: int, time: float) -> Any:
    """Return a robot at rest."""
    vector, turn = STORE.types["geometry_msgs/msg/Vector3"], STORE.types["geometry_msgs/msg/Quaternion"]
    nothing = numpy.zeros(9)
    return STORE.types["sensor_msgs/msg/Imu"](
        header(number, time, "base"), turn(0, 0, 0, 1), nothing, vector(0, 0, 0), nothing, vector(0, 0, 9.81), nothing
    )


def velocity(number: int, time: float) -> Any:
    """Return a slow drive straight on."""
    vector = STORE.types["geometry_msgs/msg/Vector3"]
    return STORE.types["geometry_msgs/msg/Twist"](vector(0.2, 0, 0), vector(0, 0, 0))


def status(number: int, time: float) -> Any:
    """Return a word."""
    return STORE.types["std_msgs/msg/String"](f"driving {number}")


def main() -> int:
    """Write the recording."""
    given = [argument for argument in sys.argv[1:] if argument != "--healthy"]
    healthy = "--healthy" in sys.argv
    path = Path(given[0] if given else "robot.bag")
    path.unlink(missing_ok=True)
    until = LENGTH_S if healthy else 60
    parts = [
        ("/scan", "sensor_msgs/msg/LaserScan", "/lidar", scan, moments(25, 0.002, 1) if healthy else scan_times()),
        ("/odom", "sensor_msgs/msg/Imu", "/odometry", imu, moments(50, 0.001, 2) if healthy else odometry_times()),
        ("/cmd_vel", "geometry_msgs/msg/Twist", "/planner", velocity, moments(20, 0.003, 3, until)),
        ("/planner/status", "std_msgs/msg/String", "/planner", status, moments(0.3, 0.01, 4, until)),
    ]
    with Writer(path) as bag:
        messages = []
        for topic, kind, node, made, times in parts:
            connection = bag.add_connection(topic, kind, typestore=STORE, callerid=node)
            messages += [(time, topic, connection, kind, made(number, time)) for number, time in enumerate(times)]
        for time, _, connection, kind, message in sorted(messages, key=lambda one: one[:2]):
            bag.write(connection, START_NS + int(time * 1e9), STORE.serialize_ros1(message, kind))
    print(f"{path}: {len(messages):,} messages in {LENGTH_S:g} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
