import signal
import sys
import time

import pytest

from roslens.live.adapters.child import LONGEST_PAUSE_S, Child, clean_environment, find_ros2_python
from roslens.live.inside.environment import environment
from roslens.live.publish.downlink import Downlink
from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.model.wire import Frame

pytestmark = pytest.mark.timed

SPEAK = """
import sys
from roslens.model.wire import VERSION, Frame, encode_frame
sys.stdout.buffer.write(encode_frame(Frame(VERSION, 'h/test', 0, 1.0)))
sys.stdout.flush()
"""


@pytest.fixture
def child():
    made = []

    def make(code):
        made.append(Child("test", [sys.executable, "-c", code], {}))
        return made[-1]

    yield make
    for one in made:
        one.close()


def until(one, what, now=0.0):
    """Poll on a clock that stands still until something of the kind has come."""
    found = []
    end = time.monotonic() + 30
    while not any(isinstance(item, what) for item in found):
        assert time.monotonic() < end
        found += one.poll(now)
    return [item for item in found if isinstance(item, what)]


def test_frames_come_and_the_end_is_a_failure_with_its_last_words(child):
    one = child(SPEAK + "sys.stderr.write('it broke'); sys.exit(3)")
    found = until(one, Failure)
    assert "ended with exit code 3: it broke" in found[0].what
    assert "0.5 s" in found[0].advice


def test_a_frame_written_just_before_the_end_is_not_lost(child):
    one = child(SPEAK)
    found = []
    while not any(isinstance(item, Failure) for item in found):
        found += one.poll(0.0)
    assert isinstance(found[0], Frame)


def test_it_starts_again_with_pauses_that_grow_and_stop_growing():
    one = Child("test", ["/no/such/program"], {})
    now, pauses = 0.0, []
    for _ in range(9):
        (failure,) = one.poll(now)
        assert "/no/such/program cannot be started" in failure.what
        assert one.poll(now) == []
        pause = float(failure.advice.split()[-2])
        pauses.append(pause)
        now += pause
    assert pauses == [0.5, 1, 2, 4, 8, 16, 30, 30, 30]
    assert pauses[-1] == LONGEST_PAUSE_S


ECHO = """
import sys
from roslens.model.wire import VERSION, Frame, encode_frame
for line in sys.stdin.buffer:
    sys.stdout.buffer.write(encode_frame(Frame(VERSION, line.decode().strip(), 0, 1.0)))
    sys.stdout.flush()
    if line == b"end\\n":
        sys.exit(0)
"""


def test_what_is_said_to_it_arrives_also_after_it_was_started_again():
    line = Downlink()
    one = Child("test", [sys.executable, "-c", ECHO], {}, line)
    one.poll(0.0)
    line.say(b"hello\n")
    assert [frame.sender for frame in until(one, Frame)] == ["hello"]
    line.say(b"end\n")
    until(one, Failure)
    line.say(b"lost\n")
    assert line.lost == 1
    one.poll(100.0)
    line.say(b"again\n")
    assert [frame.sender for frame in until(one, Frame)] == ["again"]
    one.close()


def test_one_that_lived_long_starts_again_soon(child):
    one = child("pass")
    until(one, Failure, 0.0)
    until(one, Failure, 1.0)
    (failure,) = [item for item in one.poll(100.0) + until(one, Failure, 200.0) if isinstance(item, Failure)]
    assert "0.5 s" in failure.advice


def test_garbage_ends_it(child):
    one = child("import sys, time; sys.stdout.write('x' * 100); sys.stdout.flush(); time.sleep(60)")
    (failure,) = until(one, Failure)
    assert "signal 9" in failure.what
    assert "expected at most 16,000,000" in failure.what


def test_errors_that_it_prints_are_told_once_while_it_runs(child):
    one = child("import sys, time\nfor _ in range(3): print('[ERROR] no', file=sys.stderr, flush=True)\ntime.sleep(60)")
    assert [failure.what for failure in until(one, Failure)] == ["[ERROR] no"]
    one.close()
    assert one.fileno() is None


def test_hooks_and_the_loader_path_of_wheels_are_not_passed_on():
    base = {"HOME": "/", "LD_LIBRARY_PATH": "/wheels", "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1"}
    assert clean_environment(base | environment(base)).keys() == {"HOME", "ROSLENS_COUNTERS"}
    assert clean_environment({"LD_LIBRARY_PATH": "/opt/ros"}) == {"LD_LIBRARY_PATH": "/opt/ros"}


def test_a_python_without_rclpy_is_named_with_its_reason():
    with pytest.raises(UsageError, match="No module named 'rclpy'"):
        find_ros2_python(sys.executable, {})
    with pytest.raises(UsageError, match="/no/such: No such file"):
        find_ros2_python("", {"ROSLENS_ROS2_PYTHON": "/no/such"})


STUBBORN = """
import signal, sys, time
signal.signal(signal.SIGTERM, lambda *_: None)
print('[ERROR] ready', file=sys.stderr, flush=True)
while True: time.sleep(60)
"""


def test_it_is_asked_to_end_before_it_is_killed(child, monkeypatch):
    orderly = child("import sys, time; print('[ERROR] ready', file=sys.stderr, flush=True); time.sleep(60)")
    stubborn = child(STUBBORN)
    monkeypatch.setattr("roslens.live.adapters.child._STOP_S", 0.2)
    how = []
    for one in (orderly, stubborn):
        until(one, Failure)
        process = one._process
        one.close()
        how.append(process.returncode)
    assert how == [-signal.SIGTERM, -signal.SIGKILL]


def test_it_may_be_asked_to_end_before_anybody_waits_for_it(child):
    one = child("import sys, time; print('[ERROR] ready', file=sys.stderr, flush=True); time.sleep(60)")
    one.end()
    until(one, Failure)
    process = one._process
    one.end()
    assert process.wait(60) == -signal.SIGTERM
    one.close()
