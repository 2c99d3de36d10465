from __future__ import annotations

import pytest

from roslens.live.window.voice import LEAST_PATIENCE_S, Voice, Voices


def speaking(voice, start, end, every=0.2, offset=0.0):
    """Let a voice speak, always up to date, and return when it was heard last."""
    now = start
    while now < end:
        now = round(now + every, 6)
        voice.hear(now + offset)
        voice.settle(now)
    return now


@pytest.fixture
def voice():
    return Voice("robot/agent", 0.0)


def test_a_voice_is_silent_after_its_patience_and_since_it_was_heard(voice):
    now = speaking(voice, 0.0, 10.0)
    assert not voice.settle(now + LEAST_PATIENCE_S)
    assert voice.settle(now + LEAST_PATIENCE_S + 0.1)
    assert (voice.silent, voice.since) == (True, now)
    assert not voice.settle(now + 5.0)
    voice.hear(now + 6.0)
    assert voice.settle(now + 6.0)
    assert (voice.silent, voice.since) == (False, now + 6.0)


def test_who_speaks_seldom_is_waited_for(voice):
    now = speaking(voice, 0.0, 10.0, every=1.0)
    assert not voice.settle(now + 2.9)
    assert voice.settle(now + 3.1)


def test_a_long_silence_does_not_make_patient(voice):
    now = speaking(voice, 0.0, 10.0)
    voice.settle(now + 10.0)
    now = speaking(voice, now + 10.0, now + 12.0)
    assert voice.patience == LEAST_PATIENCE_S
    assert voice.settle(now + LEAST_PATIENCE_S + 0.1)


def test_what_waited_for_a_line_vouches_for_its_own_time_alone(voice):
    now = speaking(voice, 0.0, 10.0)
    voice.settle(now + 3.0)
    voice.hear(now + 0.2)
    voice.settle(now + 3.0)
    assert voice.behind(now + 3.0) == pytest.approx(2.8, abs=0.01)
    voice.hear(now + 3.0)
    voice.settle(now + 3.1)
    assert voice.behind(now + 3.1) == pytest.approx(0.1, abs=0.01)


@pytest.mark.parametrize("offset", [-3600.0, -0.3, 0.3, 3600.0])
def test_a_clock_that_is_set_is_no_delay(voice, offset):
    now = speaking(voice, 0.0, 10.0)
    voice.hear(now + 0.2 + offset)
    voice.settle(now + 0.2)
    assert voice.behind(now + 0.2) <= 0.41
    now = speaking(voice, now + 0.2, now + 1.0, offset=offset)
    assert voice.behind(now) <= 0.6


def test_clocks_that_drift_apart_are_no_delay(voice):
    for turn in range(1, 36_000):
        voice.hear(turn * 0.2 * (1 - 2e-4))
        voice.settle(turn * 0.2)
    assert voice.behind(turn * 0.2) < 0.05


def test_a_monitor_that_was_stopped_blames_nobody():
    voices = Voices(0.0)
    voice = voices.of("robot/agent", 0.0)
    for turn in range(1, 50):
        voice.hear(turn * 0.2)
        assert not voices.settle(turn * 0.2)
    assert not voices.settle(20.0)
    assert not voices.settle(20.1)
    assert not voice.silent
    assert voices.settle(21.6) == [voice]
