"""What is known of a machine that gave no time to a test."""

import os
import signal
import time

import pytest
from starved import Sleeper, Watched

pytestmark = pytest.mark.timed


@pytest.fixture
def sleeper():
    made = Sleeper()
    yield made
    made.end()


def stop(sleeper, length_s):
    """Let nothing of the sleeper run for a while, as a busy machine does."""
    pid = sleeper._process.pid
    begun = time.monotonic()
    os.kill(pid, signal.SIGSTOP)
    while time.monotonic() - begun < length_s:
        pass
    os.kill(pid, signal.SIGCONT)


def test_a_process_that_stood_still_tells_for_how_long(sleeper):
    begun = time.monotonic()
    for _ in range(20):  # it may be stopped while it looks, and not while it sleeps
        stop(sleeper, 0.4)
        if max(sleeper.told(begun).get("late", [0.0])) >= 0.25:
            break
    else:
        pytest.fail(f"it tells {sleeper.told(begun)}")
    later = time.monotonic() + 1000
    assert sleeper.told(later) == {}, "of what was before nothing is told"
    sleeper.forget(later)
    assert sleeper._told == []


def test_it_tells_how_fast_a_loop_turns_whenever_it_is_asked(sleeper):
    found = sleeper.told(time.monotonic())
    assert min(found["slow"]) > 0.1
    assert min(found["crowded"]) > 0.9


def test_it_says_so_when_it_has_ended(sleeper):
    sleeper._process.kill()
    sleeper._process.wait()
    with pytest.raises((RuntimeError, BrokenPipeError)):
        sleeper.told(0.0)


class Told:
    def __init__(self, **told):
        self.all = told
        self.asked = None

    def forget(self, before):
        self.asked = before

    def told(self, begun):
        assert begun == self.asked
        return self.all


@pytest.mark.parametrize(
    ("told", "said"),
    [
        ({}, ""),
        ({"late": [0.09], "slow": [1.5, 1.6], "crowded": [1.1, 2.0]}, ""),
        ({"late": [0.12, 0.5]}, "a sleeping process was woken 0.50 s late"),
        ({"slow": [2.44, 1.0]}, "an empty loop took 2.4 times what it takes on a calm machine"),
        ({"crowded": [3.0]}, "a loop took 3.0 times what it took of a processor, for others had it"),
    ],
)
def test_what_was_noticed_is_said(told, said):
    watched = Watched(Told(**told))
    watched.begin(7.0)
    assert watched.starved() == said
