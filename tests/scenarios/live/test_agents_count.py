"""What nodes of ROS 2 count on hosts where there is no monitor and no ROS for it: agents tell it."""

from __future__ import annotations

import json
import time

import pytest

from roslens.live.inside.preload import why_no_library
from testbed import fault_table, robot_ros2
from testbed.allowed import why_not
from testbed.hosts import Bed
from testbed.watched import ROSLENS, Watched

pytestmark = [pytest.mark.real, pytest.mark.slow]

GRACE = 4.0
SCAN = "connection:/lidar > /scan > /planner"


@pytest.mark.timeout(120)
def test_agents_tell_what_nodes_on_their_hosts_count():
    if reason := why_not() or robot_ros2.why_not():
        pytest.skip(reason)
    with Watched("ros2") as watched:
        started = time.monotonic()
        there = {(f"node:{name}", "presence") for name in fault_table.NODES}
        watched.wait_until_ok({(SCAN, "latency"), (SCAN, "loss"), ("topic:/scan", "rate"), *there})
        watched.wait("the grace of the reference is over", lambda: time.monotonic() - started > GRACE, 2 * GRACE)
        lidar = watched.robot.processes["lidar"]
        began = time.time()
        lidar.kill()
        key = ("node:/lidar", "presence")
        watched.wait("the crash is told", lambda: watched.standing()[key].bad, 5.0)
        reported = next(one for one in watched.reported if one.key == key and one.bad)
        assert reported.time - began < 0.5
        assert {
            one.entity for one in watched.reported if one.bad and one.quantity == "presence" and one.time > began
        } == {"node:/lidar"}
        assert not [one for one in watched.reported if "gid:" in one.entity]


REFERENCE = """
kind: reference
name: services
defaults: {grace: 1 s}
constraints:
  - service: /server/get_parameters
    calls: 5..15 Hz
    response_time: <= 100 ms
    client_calls: 5..15 Hz
    client_response_time: <= 200 ms
"""
SERVER = "import rclpy; rclpy.init(); rclpy.spin(rclpy.create_node('server'))"
CLIENT = """
import rclpy, time
from rcl_interfaces.srv import GetParameters
rclpy.init()
node = rclpy.create_node("client")
client = node.create_client(GetParameters, "/server/get_parameters")
client.wait_for_service()
while True:
    begun = time.monotonic()
    rclpy.spin_until_future_complete(node, client.call_async(GetParameters.Request(names=["use_sim_time"])))
    time.sleep(max(0.1 - (time.monotonic() - begun), 0.0))
"""


@pytest.mark.timeout(120)
def test_calls_between_two_hosts_are_told_by_their_agents(tmp_path):
    if reason := why_not() or robot_ros2.why_not() or why_no_library():
        pytest.skip(reason)
    document = tmp_path / "services.yaml"
    document.write_text(REFERENCE)
    with Bed(("base", "server", "client")) as bed:
        key = str(bed.folder / "key")
        base = bed["base"]
        base.run([ROSLENS, "agent", "--new-key", key])
        python, robot = robot_ros2.python(), robot_ros2.Ros2Robot(bed)
        address = f"{base.address}:7411"
        for name, program in (("server", SERVER), ("client", CLIENT)):
            host = bed[name]
            host.start([ROSLENS, "run", "--", python, "-c", program], robot.environment(host), name="node")
            host.start([ROSLENS, "agent", address, "--key-file", key], name="agent")
        words = ["watch", "--ros2", "--listen", address, "--key-file", key, "--reference", str(document)]
        environment = {**robot.environment(base), "ROSLENS_ROS2_PYTHON": python}
        monitor = base.start([ROSLENS, *words, "--format", "json"], environment, name="watch")

        def fine():
            lines = [json.loads(line) for line in monitor.output().splitlines() if line.startswith("{")]
            states = {one["quantity"]: one["state"] for one in lines if one["is"] == "verdict"}
            return len(states) == 4 and set(states.values()) == {"ok"}

        end = time.monotonic() + 40
        while not fine():
            assert time.monotonic() < end, monitor.output()[-3000:]
            assert monitor.running
            time.sleep(0.1)
