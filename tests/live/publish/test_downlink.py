import os
import threading
import time

import pytest

from roslens.live.publish.downlink import LONGEST_WAIT_S, Downlink

pytestmark = pytest.mark.timed


def pipe():
    reading, writing = os.pipe()
    return reading, os.fdopen(writing, "wb", buffering=0)


def until(holds, seconds=60):
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.002)


def test_frames_arrive_in_order():
    reading, stream = pipe()
    line = Downlink()
    line.attach(stream)
    for text in (b"one ", b"two"):
        line.say(text)
    found = b""
    while len(found) < 7:
        found += os.read(reading, 100)
    assert (found, line.lost) == (b"one two", 0)
    line.detach()
    assert os.read(reading, 1) == b""
    os.close(reading)


def test_who_does_not_read_loses_the_oldest_and_nobody_waits():
    reading, stream = pipe()
    line = Downlink(most_waiting=100_000)
    line.attach(stream)
    begun = time.monotonic()
    for _ in range(1000):
        line.say(b"x" * 10_000)
    assert time.monotonic() - begun < 30, "nobody ever reads"
    # One is being written, and a pipe and what may wait hold the rest.
    assert line.lost > 900
    os.close(reading)
    until(lambda: threading.active_count() == 1 or not any(t.name == "downlink" for t in threading.enumerate()))
    assert stream.closed


def test_what_was_long_ago_is_told_to_nobody():
    reading, stream = pipe()
    now = [0.0]
    line = Downlink(steady=lambda: now[0])
    line.attach(stream)
    line.say(b"x" * 1_000_000)  # of which a pipe holds a part
    until(lambda: not line._waiting)
    line.say(b"old")
    now[0] = LONGEST_WAIT_S
    line.say(b"middle")
    assert line.lost == 0
    now[0] += 0.5
    line.say(b"new")
    assert line.lost == 1
    found = b""
    while not found.endswith(b"new"):
        found += os.read(reading, 100_000)
    assert found[1_000_000:] == b"middlenew"
    line.detach()
    os.close(reading)


def test_what_is_said_to_one_who_ended_is_lost_and_the_next_one_is_told_again():
    reading, stream = pipe()
    line = Downlink()
    line.say(b"before anybody was there")
    assert line.lost == 0
    line.attach(stream)
    os.close(reading)
    line.say(b"x")
    until(lambda: stream.closed)
    line.say(b"y")
    assert line.lost == 2
    reading, stream = pipe()
    line.attach(stream)
    line.say(b"again")
    assert os.read(reading, 100) == b"again"
    line.detach()
    os.close(reading)
