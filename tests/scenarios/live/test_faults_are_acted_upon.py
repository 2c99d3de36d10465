"""The robot of the test bed helps itself: what is to be done about each fault is done, and nothing else."""

from __future__ import annotations

import pytest

from testbed import action_table, robot_ros1, robot_ros2
from testbed.allowed import why_not

pytestmark = [pytest.mark.real, pytest.mark.slow, pytest.mark.table]

REASONS = {"ros1": robot_ros1.why_not, "ros2": robot_ros2.why_not}


@pytest.fixture(params=sorted(REASONS))
def generation(request):
    """A generation of ROS that is here, on a machine that lets us make hosts."""
    if reason := why_not() or REASONS[request.param]():
        pytest.skip(reason)
    return request.param


@pytest.mark.timeout(900)
def test_every_fault_is_acted_upon_and_who_observes_is_none(generation):
    rows = list(action_table.run_all(generation))
    assert len(rows) >= 12
    assert [row for row in rows if not row.nothing and row.result != "done"] == []
    assert [row for row in rows if row.nothing and row.others] == []
