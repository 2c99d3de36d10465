"""What a message costs that a tap takes, beside a subscription of rclpy with its executor.

    python benchmarks/tap.py [PYTHON WITH RCLPY]

One process publishes scans of 720 values at 1,000 Hz; a subscription with an executor and a tap take them at the same
time, so that whatever else the machine does slows both, each in a process of its own, and tell their CPU time a
message. A Python with rclpy is taken from build/ros2 otherwise.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
from pathlib import Path

ROUNDS = 5
SECONDS = 4.0
HERE = Path(__file__).resolve().parents[1]
PUBLISHER = """
import time, rclpy
from sensor_msgs.msg import LaserScan
rclpy.init()
node = rclpy.create_node('scanner')
publisher = node.create_publisher(LaserScan, '/scan', 100)
scan = LaserScan(ranges=[1.0] * 720)
due = time.monotonic()
while rclpy.ok():
    publisher.publish(scan)
    due += 0.001
    time.sleep(max(0.0, due - time.monotonic()))
"""
SUBSCRIPTION = """
import sys, time, rclpy
from sensor_msgs.msg import LaserScan
rclpy.init()
node = rclpy.create_node('listener')
count = 0
def take(message):
    global count
    count += 1
node.create_subscription(LaserScan, '/scan', take, 1000)
executor = rclpy.executors.SingleThreadedExecutor()
executor.add_node(node)
met = time.monotonic() + 2.0
while time.monotonic() < met:
    executor.spin_once(timeout_sec=0.1)
count, begun, end = 0, time.process_time(), time.monotonic() + float(sys.argv[1])
while time.monotonic() < end:
    executor.spin_once(timeout_sec=0.1)
print((time.process_time() - begun) / max(count, 1) * 1e6, count)
"""
TAP = """
import sys, time, rclpy
sys.path.append(sys.argv[2])
from rclpy.qos import QoSProfile
from sensor_msgs.msg import LaserScan
from roslens.live.adapters.ros2.tap import DEPTH, DRAIN_S, _Open
rclpy.init()
node = rclpy.create_node('tap')
subscription = node.create_subscription(LaserScan, '/scan', print, QoSProfile(depth=DEPTH), raw=True)
tap = _Open(subscription, '/scan')
def stretch(seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        tap.drain()
        time.sleep(DRAIN_S)
stretch(2.0)
tap.count, begun = 0, time.process_time()
stretch(float(sys.argv[1]))
print((time.process_time() - begun) / max(tap.count, 1) * 1e6, tap.count)
"""


def started(python: str, program: str, environment: dict[str, str]) -> subprocess.Popen[str]:
    """Start a process that takes messages."""
    command = [python, "-c", program, str(SECONDS), str(HERE / "src")]
    return subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)


def costs(python: str, environment: dict[str, str]) -> list[tuple[float, int]]:
    """Return CPU microseconds a message, and how many messages came, of a subscription and of a tap."""
    both = [started(python, program, environment) for program in (SUBSCRIPTION, TAP)]
    reported = [process.communicate(timeout=60)[0].split()[-2:] for process in both]
    return [(float(microseconds), int(count)) for microseconds, count in reported]


def main() -> None:
    """Measure both several times and print their medians and the ratio."""
    python = sys.argv[1] if len(sys.argv) > 1 else str(HERE / "build" / "ros2" / "bin" / "python")
    environment = {**os.environ, "ROS_DOMAIN_ID": "71", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    publisher = subprocess.Popen([python, "-c", PUBLISHER], env=environment)
    try:
        pairs = [costs(python, environment) for _ in range(ROUNDS)]
    finally:
        publisher.terminate()
        publisher.wait(10)
    usual = statistics.median(pair[0][0] for pair in pairs)
    tap = statistics.median(pair[1][0] for pair in pairs)
    factor = statistics.median(pair[0][0] / pair[1][0] for pair in pairs)
    print(f"subscription and executor: {usual:.1f} us a message ({pairs[-1][0][1]} in {SECONDS:g} s)")
    print(f"tap: {tap:.1f} us a message ({pairs[-1][1][1]} in {SECONDS:g} s), {factor:.1f} times cheaper")
    print(f"a core takes {1e6 / tap:,.0f} messages a second by taps")


if __name__ == "__main__":
    main()
