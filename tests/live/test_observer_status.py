from __future__ import annotations

import pytest

from roslens.live.window.observer_status import LEAST_PATIENCE_S, ObserverStatus, ObserverStatuses


def speaking(observer_status, start, end, every=0.2, offset=0.0):
    """Let a observer_status speak, always up to date, and return when it was heard last."""
    now = start
    while now < end:
        now = round(now + every, 6)
        observer_status.take_report(now + offset)
        observer_status.settle(now)
    return now


@pytest.fixture
def observer_status():
    return ObserverStatus("robot/agent", 0.0)


def test_a_voice_is_silent_after_its_patience_and_since_it_was_heard(observer_status):
    now = speaking(observer_status, 0.0, 10.0)
    assert not observer_status.settle(now + LEAST_PATIENCE_S)
    assert observer_status.settle(now + LEAST_PATIENCE_S + 0.1)
    assert (observer_status.silent, observer_status.since) == (True, now)
    assert not observer_status.settle(now + 5.0)
    observer_status.take_report(now + 6.0)
    assert observer_status.settle(now + 6.0)
    assert (observer_status.silent, observer_status.since) == (False, now + 6.0)


def test_who_speaks_seldom_is_waited_for(observer_status):
    now = speaking(observer_status, 0.0, 10.0, every=1.0)
    assert not observer_status.settle(now + 2.9)
    assert observer_status.settle(now + 3.1)


def test_a_long_silence_does_not_make_patient(observer_status):
    now = speaking(observer_status, 0.0, 10.0)
    observer_status.settle(now + 10.0)
    now = speaking(observer_status, now + 10.0, now + 12.0)
    assert observer_status.patience == LEAST_PATIENCE_S
    assert observer_status.settle(now + LEAST_PATIENCE_S + 0.1)


def test_what_waited_for_a_line_vouches_for_its_own_time_alone(observer_status):
    now = speaking(observer_status, 0.0, 10.0)
    observer_status.settle(now + 3.0)
    observer_status.take_report(now + 0.2)
    observer_status.settle(now + 3.0)
    assert observer_status.behind(now + 3.0) == pytest.approx(2.8, abs=0.01)
    observer_status.take_report(now + 3.0)
    observer_status.settle(now + 3.1)
    assert observer_status.behind(now + 3.1) == pytest.approx(0.1, abs=0.01)


@pytest.mark.parametrize("offset", [-3600.0, -0.3, 0.3, 3600.0])
def test_a_clock_that_is_set_is_no_delay(observer_status, offset):
    now = speaking(observer_status, 0.0, 10.0)
    observer_status.take_report(now + 0.2 + offset)
    observer_status.settle(now + 0.2)
    assert observer_status.behind(now + 0.2) <= 0.41
    now = speaking(observer_status, now + 0.2, now + 1.0, offset=offset)
    assert observer_status.behind(now) <= 0.6


def test_clocks_that_drift_apart_are_no_delay(observer_status):
    for turn in range(1, 36_000):
        observer_status.take_report(turn * 0.2 * (1 - 2e-4))
        observer_status.settle(turn * 0.2)
    assert observer_status.behind(turn * 0.2) < 0.05


def test_a_monitor_that_was_stopped_blames_nobody():
    statuses = ObserverStatuses(0.0)
    observer_status = statuses.of("robot/agent", 0.0)
    for turn in range(1, 50):
        observer_status.take_report(turn * 0.2)
        assert not statuses.settle(turn * 0.2)
    assert not statuses.settle(20.0)
    assert not statuses.settle(20.1)
    assert not observer_status.silent
    assert statuses.settle(21.6) == [observer_status]
