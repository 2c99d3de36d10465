import queue
import socket
import subprocess
import sys

import pytest

from roslens.live.adapters.ros1.ends import Ends

pytestmark = pytest.mark.timed


@pytest.fixture
def watched():
    heard = queue.SimpleQueue()
    ends = Ends(heard.put)
    yield ends, heard
    ends.close()


def sleeper():
    return subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)


def test_the_end_of_a_process_is_told_at_once(watched):
    ends, heard = watched
    with sleeper() as process:
        assert ends.process("/a", process.pid)
        assert ends.process("/a", process.pid)
        process.kill()
        assert heard.get(timeout=30) == "/a"


def test_the_end_of_a_connection_is_told(watched):
    ends, heard = watched
    here, there = socket.socketpair()
    with here:
        ends.connection("/b", here.fileno())
        there.sendall(b"data alone is no end")
        assert heard.empty()
        ends.connection("/b", here.fileno())
        there.close()
        assert heard.get(timeout=30) == "/b"


def test_what_is_forgotten_is_not_told(watched):
    ends, heard = watched
    with sleeper() as first, sleeper() as second:
        ends.process("/a", first.pid)
        ends.process("/b", second.pid)
        ends.forget("/a")
        ends.forget("/nobody")
        first.kill()
        first.wait()
        second.kill()
        assert heard.get(timeout=30) == "/b"


def test_a_process_that_is_not_there_cannot_be_watched(watched):
    assert not watched[0].process("/a", 2**22 + 5)
    watched[0].connection("/a", -1)
