"""Which faults strike: the same for a seed, each of them, and pairs only of what can be told apart."""

import itertools

import pytest

from testbed.action_table import CASES
from testbed.random_faults import LEFT_OUT, MORE, strikes


@pytest.mark.parametrize("generation", ["ros1", "ros2"])
def test_every_fault_strikes_before_any_strikes_again(generation):
    wanted = sorted(one.name for one in (*CASES, *MORE) if generation in one.generations and one.name not in LEFT_OUT)
    came = []
    for one in strikes(5, generation):
        came += [case.name for case in one.cases]
        if len(came) >= len(wanted):
            break
    assert sorted(came) == wanted


def test_a_seed_tells_what_strikes():
    def first(seed):
        return [(one.name, one.lasts) for one in itertools.islice(strikes(seed, "ros2"), 40)]

    assert first(3) == first(3)
    assert first(3) != first(4)


def test_two_at_a_time_strike_different_nodes_that_are_acted_upon():
    pairs = [one.cases for one in itertools.islice(strikes(1, "ros1"), 400) if len(one.cases) == 2]
    assert len(pairs) > 20
    assert all(one.does and other.does and not one.on & other.on for one, other in pairs)
