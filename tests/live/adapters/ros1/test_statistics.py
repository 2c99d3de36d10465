import contextlib
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros1.statistics import StatisticsError, read_statistics
from roslens.live.window.plausible_tally import plausible_tally
from roslens.model.traffic.tally import NOTHING, Observer


def packed(names=("/chat", "/talker", "/listener"), window=(100, 0, 102, 500_000_000), counts=(50, 1, 1500), times=()):
    text = b"".join(struct.pack("<I", len(name.encode())) + name.encode() for name in names)
    durations = (*times, *([0] * (12 - len(times))))
    return text + struct.pack("<IIIIiii12i", *window, *counts, *durations)


PERIOD = (0, 50_000_000, 0, 10_000_000, 0, 80_000_000)
AGE = (0, 5_000_000, 0, 1_000_000, 0, 9_000_000)


def test_statistics_become_a_tally():
    tally = read_statistics(packed(times=(*PERIOD, *AGE)), 1000.0, "vm")
    assert (tally.topic, tally.publisher, tally.subscriber) == ("/chat", "/talker", "/listener")
    assert (tally.start, tally.end, tally.count, tally.bytes, tally.lost) == (997.5, 1000.0, 50, 1500, 1)
    assert tally.period.count == 50
    assert tally.period.mean == pytest.approx(0.05)
    assert tally.period.deviation == pytest.approx(0.01)
    assert tally.period.greatest == pytest.approx(0.08)
    assert tally.age.count == 50
    assert tally.age.mean == pytest.approx(0.005)
    assert (tally.observer, tally.host) == (Observer.INSIDE, "vm")
    assert plausible_tally(tally) is tally


def test_a_topic_without_a_header_has_no_age_and_no_loss():
    tally = read_statistics(packed(times=PERIOD), 1000.0)
    assert tally.age == NOTHING
    assert tally.lost == -1


def test_the_time_before_a_single_message_is_known():
    tally = read_statistics(packed(window=(100, 0, 100, 200_000_000), counts=(1, 0, 30), times=PERIOD), 1000.0)
    assert (tally.count, tally.period.count) == (1, 1)
    assert tally.period.mean == pytest.approx(0.05)


def test_an_age_may_be_negative_since_clocks_differ():
    tally = read_statistics(packed(times=(*PERIOD, -1, 750_000_000, 0, 0, -1, 750_000_000)), 1000.0)
    assert tally.age.mean == pytest.approx(-0.25)


@pytest.mark.parametrize(
    "body",
    [
        b"",
        packed()[:-1],
        packed() + b"x",
        b"\xff\xff\xff\xff" + packed(),
        packed(counts=(-1, 0, 0)),
        packed(window=(100, 0, 99, 0)),
        packed(window=(0, 0, 2**32 - 1, 0)),
    ],
)
def test_what_is_none_is_refused(body):
    with pytest.raises(StatisticsError):
        read_statistics(body, 1000.0)


INT = st.integers(-(2**31), 2**31 - 1)


@given(st.lists(INT, min_size=3, max_size=3), st.lists(INT, min_size=12, max_size=12))
def test_no_numbers_make_an_impossible_tally(counts, times):
    with contextlib.suppress(StatisticsError):
        tally = read_statistics(packed(counts=counts, times=times), 1000.0)
        assert tally.period.least <= tally.period.greatest
        assert tally.period.count <= tally.count
        assert tally.lost >= -1 <= tally.bytes


@given(st.binary(max_size=200))
def test_no_bytes_make_it_fall_over(body):
    with contextlib.suppress(StatisticsError):
        read_statistics(body, 1000.0)
