"""A real node that tells statistics of its subscription as rclcpp does: they are rated, though nobody counts traffic.

There are no wheels of rclcpp. What it would send is sent by rclpy, with statistics_msgs built for it.
"""

from __future__ import annotations

import subprocess

import pytest
from watched_until import states, watch_until

pytestmark = pytest.mark.real

STATISTICS = {
    "StatisticDataPoint": "uint8 data_type\nfloat64 data\n",
    "MetricsMessage": (
        "string measurement_source_name\nstring metrics_source\nstring unit\nbuiltin_interfaces/Time window_start\n"
        "builtin_interfaces/Time window_stop\nStatisticDataPoint[] statistics\n"
    ),
}
TALKER = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node('talker')
publisher = node.create_publisher(String, '/chatter', 10)
node.create_timer(0.1, lambda: publisher.publish(String(data='x')))
rclpy.spin(node)
"""
LISTENER = """
import rclpy
from std_msgs.msg import String
from statistics_msgs.msg import MetricsMessage, StatisticDataPoint
rclpy.init()
node = rclpy.create_node('listener', namespace='/arm')
told = node.create_publisher(MetricsMessage, '/statistics', 10)
node.create_subscription(String, '/chatter', lambda _: None, 10)
since = node.get_clock().now().to_msg()
def tell():
    global since
    until = node.get_clock().now().to_msg()
    # Average, least, greatest, deviation and number of samples, in the order of their numbers.
    ages, periods = (30.0, 20.0, 50.0, 5.0, 10.0), (100.0, 90.0, 110.0, 2.0, 10.0)
    for source, values in (('message_age', ages), ('message_period', periods)):
        points = [StatisticDataPoint(data_type=kind, data=value) for kind, value in enumerate(values, 1)]
        told.publish(MetricsMessage(measurement_source_name='listener', metrics_source=source, unit='ms',
                                    window_start=since, window_stop=until, statistics=points))
    since = until
node.create_timer(1.0, tell)
rclpy.spin(node)
"""
LISTENS = "/arm/listener"
REFERENCE = """
kind: reference
name: statistics
constraints:
  - connection: /chatter
    subscriber: /arm/listener
    rate: 8..12 Hz
    age: <= 10 ms
    age_max: <= 100 ms
"""


@pytest.mark.timeout(240)
def test_what_a_subscription_tells_of_itself_is_rated(python, built, alone, tmp_path):
    environment = alone | {"PYTHONPATH": str(built("statistics_msgs", STATISTICS))}
    reference = tmp_path / "reference.yaml"
    reference.write_text(REFERENCE)
    nodes = [subprocess.Popen([python, "-c", code], env=environment) for code in (TALKER, LISTENER)]
    wanted = {"rate": "ok", "age": "high", "age_max": "ok"}
    try:
        reported = watch_until(
            lambda lines: states(lines, LISTENS) == wanted, ["--ros2", "--reference", str(reference)], environment
        )
    finally:
        for node in nodes:
            node.kill()
            node.wait()
    last = {one["quantity"]: one for one in reported.lines if one["is"] == "verdict" and LISTENS in one["entity"]}
    assert states(reported.lines, LISTENS) == wanted, reported
    assert last["age"]["value"] == pytest.approx(0.03)
    assert last["age_max"]["value"] == pytest.approx(0.05)
    assert {one["entity"] for one in last.values()} == {"connection:/talker > /chatter > /arm/listener"}
