"""The robot of the test bed, watched as users do it: what breaks is reported, in time, and nothing else is."""

from __future__ import annotations

import pytest

from testbed import fault_table, robot_ros1, robot_ros2
from testbed.allowed import why_not

pytestmark = pytest.mark.real

REASONS = {"ros1": robot_ros1.why_not, "ros2": robot_ros2.why_not}
UNSEEN = {("ros1", "5 % loss on the sensor's link")}
"""TCP sends again what is lost, mostly before a message is late enough to be reported: docs/faults.md."""
QUICK = ("lidar crashes", "rate of the lidar drops, 25 to 10 Hz")


@pytest.fixture(params=sorted(REASONS))
def generation(request):
    """A generation of ROS that is here, on a machine that lets us make hosts."""
    if reason := why_not() or REASONS[request.param]():
        pytest.skip(reason)
    return request.param


def missed(rows):
    """Return the rows of faults that were not reported, reported late, or reported for ever."""
    wanted = [row for row in rows if (row.generation, row.name) not in UNSEEN]
    return [row for row in wanted if row.alarm is None or row.alarm > row.allowed or row.ok is None]


@pytest.mark.timeout(120)
def test_a_crash_and_a_rate_that_drops_are_told(generation):
    rows = list(fault_table.run_all(generation, QUICK, exactly=True))
    assert [row.name for row in rows] == [case.name for case in fault_table.CASES if case.name in QUICK]
    assert missed(rows) == []


@pytest.mark.slow
@pytest.mark.table
@pytest.mark.timeout(360)
def test_every_fault_is_told(generation):
    rows = list(fault_table.run_all(generation))
    assert len(rows) >= 10
    assert missed(rows) == []
