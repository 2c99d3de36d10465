import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros1.accumulator import Accumulator
from roslens.live.window.plausible_tally import plausible_tally
from roslens.model.traffic.tally import NOTHING, Observer


def head(sequence, stamp=0.0):
    return struct.pack("<III", sequence % 2**32, int(stamp), round((stamp % 1) * 1e9))


def test_messages_are_counted():
    seen = Accumulator("/scan", "/lidar", True, 100.0)
    for number in range(4):
        seen.message(50, head(7 + number, 100.0 + number), 100.25 + number)
    tally = seen.take(104.0, "vm")
    assert (tally.topic, tally.publisher, tally.subscriber) == ("/scan", "/lidar", "")
    assert (tally.start, tally.end, tally.count, tally.bytes) == (100.0, 104.0, 4, 200)
    assert (tally.first, tally.last, tally.lost) == (100.25, 103.25, 0)
    assert (tally.period.count, tally.period.mean, tally.period.deviation) == (3, 1.0, 0.0)
    assert tally.age.mean == pytest.approx(0.25)
    assert (tally.observer, tally.host) == (Observer.TAP, "vm")


def test_the_gap_across_stretches_belongs_to_the_later_one():
    seen = Accumulator("/scan", "/lidar", False, 0.0)
    seen.message(1, b"", 1.0)
    seen.take(2.0, "")
    silent = seen.take(3.0, "")
    assert (silent.start, silent.count, silent.bytes, silent.first, silent.period) == (2.0, 0, 0, 0.0, NOTHING)
    seen.message(1, b"", 3.5)
    assert seen.take(4.0, "").period.mean == 2.5


@pytest.mark.parametrize(
    ("sequences", "lost"),
    [
        ([5, 6, 7], 0),
        ([5, 8], 2),
        ([5, 6, 10, 11, 13], 4),
        ([2**32 - 1, 0, 1], 0),
        ([2**32 - 1, 1], 1),
        ([0, 0, 0], -1),
        ([5], -1),
        ([500, 3, 4], 0),
    ],
)
def test_lost_messages_by_sequence(sequences, lost):
    seen = Accumulator("/scan", "/lidar", True, 0.0)
    for number, sequence in enumerate(sequences):
        seen.message(20, head(sequence), 1.0 + number)
    assert seen.take(99.0, "").lost == lost


def test_a_stamp_of_zero_has_no_age():
    seen = Accumulator("/scan", "/lidar", True, 0.0)
    seen.message(20, head(1), 1.0)
    assert seen.take(2.0, "").age == NOTHING


@given(st.lists(st.tuples(st.binary(max_size=14), st.floats(0, 10)), max_size=20), st.booleans())
def test_every_tally_is_plausible(messages, stamped):
    seen, now = Accumulator("/t", "/n", stamped, 5.0), 5.0
    for body, step in messages:
        now += step
        seen.message(len(body), body, now)
    tally = seen.take(now, "")
    assert plausible_tally(tally) is tally
