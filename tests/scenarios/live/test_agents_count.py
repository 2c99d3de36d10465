"""What nodes of ROS 2 count on hosts where there is no monitor and no ROS for it: agents tell it."""

from __future__ import annotations

import time

import pytest

from testbed import fault_table, robot_ros2
from testbed.allowed import why_not
from testbed.watched import Watched

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
        told = next(one for one in watched.told if one.key == key and one.bad)
        assert told.time - began < 0.5
        assert {one.entity for one in watched.told if one.bad and one.quantity == "presence" and one.time > began} == {
            "node:/lidar"
        }
        assert not [one for one in watched.told if "gid:" in one.entity]
