import queue
import subprocess
import sys

import pytest

from roslens.live.adapters.ros2.process_ends import ProcessEnds

pytestmark = pytest.mark.timed


def test_the_end_of_a_process_is_told_once_and_at_once():
    reported = queue.SimpleQueue()
    ends = ProcessEnds(lambda pid, how: reported.put((pid, how)))
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as process:
        ends.watch(process.pid)
        ends.watch(process.pid)
        process.kill()
        assert reported.get(timeout=10) == (process.pid, "signal 9")
    ends.watch(process.pid)  # long gone
    assert reported.get(timeout=10) == (process.pid, "unknown")
    assert reported.empty()
    ends.close()
