"""What is wrong is never called ok, and no reaction does harm: each case once, and twenty times by `make faults`."""

from __future__ import annotations

import pytest
from wrong_ok.cases import CASES, OF_ROS1
from wrong_ok.scene import Scene

from testbed import robot_ros1

pytestmark = [pytest.mark.real, pytest.mark.slow]


@pytest.fixture
def scene(tmp_path, python):
    """A robot of its own on this host."""
    found = Scene(tmp_path, python)
    yield found
    found.close()


def skip_without_ros1(name):
    """Skip a case of ROS 1 where there is none."""
    if name in OF_ROS1 and (reason := robot_ros1.why_not()):
        pytest.skip(reason)


@pytest.mark.timeout(300)
@pytest.mark.parametrize("name", CASES)
def test_nothing_wrong_is_called_ok_and_nothing_done_does_harm(scene, name):
    skip_without_ros1(name)
    assert CASES[name](scene) == []


@pytest.mark.table
@pytest.mark.timeout(300)
@pytest.mark.parametrize("turn", range(20))
@pytest.mark.parametrize("name", CASES)
def test_twenty_times(scene, name, turn):
    skip_without_ros1(name)
    assert CASES[name](scene) == []
