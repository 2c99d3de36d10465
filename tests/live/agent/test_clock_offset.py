import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.agent.clock_offset import ClockOffset


def exchange(offset, there, back, at=100.0):
    """Return the four times of an exchange over a line with these delays; our clock is ahead by ``offset``."""
    received = at - offset + there
    reported = received + 0.0001
    return at, received, reported, reported + offset + back


@given(st.floats(-10, 10), st.floats(0, 0.2), st.floats(0, 0.2))
def test_the_error_is_within_the_bound(offset, there, back):
    clock = ClockOffset()
    clock.add(*exchange(offset, there, back))
    found = clock.now()
    assert abs(found.ahead - offset) <= found.bound + 1e-9


def test_short_trips_count():
    rng = random.Random(3)
    clock = ClockOffset()
    for number in range(16):
        delay = 0.0002 if number % 4 == 0 else 0.02 + rng.random() * 0.05
        clock.add(*exchange(0.25, delay, 0.0002))
    assert clock.now().ahead == pytest.approx(0.25, abs=1e-4)


def test_nothing_is_known_before_an_exchange_and_nonsense_is_no_exchange():
    clock = ClockOffset()
    assert clock.now() is None
    clock.add(1.0, 2.0, 1.5, 3.0)
    clock.add(5.0, 1.0, 1.0, 4.0)
    clock.add(float("nan"), 1.0, 1.0, 4.0)
    assert clock.now() is None
