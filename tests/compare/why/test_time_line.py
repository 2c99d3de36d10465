import random

import numpy as np
import pytest

from roslens.compare.why.time_line import Break, BreakKind, time_line


def regular(hertz, begin, end):
    return np.arange(begin, end, 1 / hertz)


def kinds(times, end):
    return [one.kind for one in time_line(np.asarray(times), end).breaks]


def test_a_steady_topic_has_no_break():
    line = time_line(regular(10, 0, 30), 30.0)
    assert (line.count, line.breaks) == (300, ())
    assert line.rate == pytest.approx(10)
    assert line.usual == pytest.approx(0.1)


def test_no_message_and_few_messages_have_no_rate():
    assert time_line(np.zeros(0), 5.0).count == 0
    once = time_line(np.asarray([1.0]), 100.0)
    assert (once.first, once.last, once.rate, once.breaks) == (1.0, 1.0, 0.0, ())
    assert time_line(np.asarray([1.0, 2.0, 3.0]), 100.0).breaks == ()
    assert time_line(np.asarray([1.0] * 9), 100.0).breaks == ()


def test_a_topic_that_stops_is_told_with_its_last_message():
    (found,) = time_line(regular(10, 0, 20), 60.0).breaks
    assert found.kind is BreakKind.STOP
    assert (found.since, found.until) == (pytest.approx(19.9), 60.0)


def test_a_slow_topic_does_not_stop_between_two_messages():
    assert kinds(regular(0.1, 0, 100), 130.0) == []
    assert kinds(regular(0.1, 0, 100), 141.0) == [BreakKind.STOP]


def test_silence_below_a_second_is_none_however_fast_a_topic_is():
    assert kinds(regular(1000, 0, 10), 10.9) == []
    assert kinds(regular(1000, 0, 10), 11.1) == [BreakKind.STOP]


def test_a_gap_that_ends_is_told_with_both_its_ends():
    times = np.concatenate([regular(20, 0, 10), regular(20, 14, 30)])
    assert time_line(times, 30.0).breaks == (Break(BreakKind.GAP, pytest.approx(9.95), pytest.approx(14.0)),)


def test_a_lower_rate_to_the_end_is_told_from_its_first_late_message():
    times = np.concatenate([regular(10, 0, 40), regular(2.5, 40, 60)])
    (found,) = time_line(times, 60.0).breaks
    assert found.kind is BreakKind.SLOW
    assert found.since == pytest.approx(40, abs=0.5)


def test_bursts_and_random_arrivals_are_not_slow():
    rng = random.Random(3)
    for _ in range(200):
        times = np.cumsum([rng.expovariate(10) for _ in range(rng.randrange(60, 800))])
        assert BreakKind.SLOW not in kinds(times, float(times[-1]))
