"""What is known of a machine that gave no time to a test."""

import os
import signal
import time

import pytest
import starved
from starved import LATE_S, Sleeper, Watched


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
    while not sleeper.worst_s(begun) and time.monotonic() - begun < 20:
        stop(sleeper, 0.4)
        told = time.monotonic() + 1.0
        while not sleeper.worst_s(begun) and time.monotonic() < told:
            pass
    assert sleeper.worst_s(begun) >= 0.25
    assert sleeper.worst_s(time.monotonic() + 1000) == 0.0, "of what was before nothing is told"


def test_a_test_is_starved_by_what_happened_since_it_began(sleeper, monkeypatch):
    monkeypatch.setattr(starved, "slowness", lambda: 1.0)
    monkeypatch.setattr(Sleeper, "worst_s", lambda self, begun: 0.5 if begun < moment else 0.0)
    moment = 0.0
    watched = Watched(sleeper)
    assert watched.starved() == ""
    moment = time.monotonic() + 1000
    assert watched.starved() == "a sleeping process was woken 0.50 s late"


def test_a_slow_processor_starves(sleeper, monkeypatch):
    monkeypatch.setattr(starved, "slowness", lambda: 2.44)
    monkeypatch.setattr(Sleeper, "worst_s", lambda self, begun: LATE_S)
    assert Watched(sleeper).starved() == "an empty loop takes 2.4 times what it takes on a calm machine"
