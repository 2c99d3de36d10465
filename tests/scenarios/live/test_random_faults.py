"""Half an hour of random faults on each generation of ROS: what is to be done is done, nothing else, and nothing leaks.

ROSLENS_STRIKES_S shortens it, ROSLENS_STRIKES_SEED repeats what was seen: a failure says which seed it had.
"""

from __future__ import annotations

import os
import time

import pytest

from testbed import random_faults, robot_ros1, robot_ros2
from testbed.allowed import why_not
from testbed.random_faults import Soaked

pytestmark = [pytest.mark.real, pytest.mark.slow, pytest.mark.nightly]

LENGTH_S = float(os.environ.get("ROSLENS_STRIKES_S", "1800"))
MOST_BYTES_A_SECOND = 2000
"""As in `test_soak.py`: 170 MB a day."""
SLACK_BYTES = 5_000_000
"""The allocator's pages, and what is met for the first time after the first third."""
REASONS = {"ros1": robot_ros1.why_not, "ros2": robot_ros2.why_not}


@pytest.mark.timeout(LENGTH_S + 600)
@pytest.mark.parametrize("generation", sorted(REASONS))
def test_random_faults_are_acted_upon_and_nothing_else_is(generation):
    if reason := why_not() or REASONS[generation]():
        pytest.skip(reason)
    seed = int(os.environ.get("ROSLENS_STRIKES_SEED", "0")) or int(time.time())
    *found, soaked = random_faults.soak(generation, LENGTH_S, seed)
    assert isinstance(soaked, Soaked)
    judged = [one for one in found if not one.starved]
    assert [str(one) for one in judged if not one.right] == [], seed
    assert len(judged) >= LENGTH_S / 90, (seed, "others took the machine", [str(one) for one in found])
    most = MOST_BYTES_A_SECOND * soaked.level_s + SLACK_BYTES
    assert soaked.grown
    assert max(soaked.grown.values()) < most, (seed, soaked.grown)
