import os
import time

from roslens.live.join.waiting import Waiting


class Reads:
    def __init__(self, *files):
        self.files = files

    def descriptors(self):
        return self.files


def test_it_wakes_when_any_source_has_something():
    ours, theirs = os.pipe()
    try:
        waiting = Waiting([Reads(ours), Reads()], 0.2)
        begun = time.monotonic()
        assert waiting.wait() == 0
        assert time.monotonic() - begun >= 0.19
        os.write(theirs, b"x")
        waiting = Waiting([Reads(ours), Reads()], 60.0)
        begun = time.monotonic()
        for _ in range(10):
            assert waiting.wait() == 0
        assert 0.04 < time.monotonic() - begun < 60, "never more often than every 5 ms, and not after a minute each"
    finally:
        os.close(ours)
        os.close(theirs)


def test_sources_that_have_to_be_asked_share_the_time():
    assert Waiting([Reads(), object(), object(), object()], 0.2).wait() == 0.05
    assert Waiting([], 0.2).wait() == 0.2
