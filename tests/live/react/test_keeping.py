import threading

import pytest

from roslens.live.act.keeping import Keeping, Topic
from roslens.live.act.ros import ActionError
from roslens.live.adapters.bag.open_bag import open_bag

TEXT = "bool data\n"
STOP = Topic("/stop", "std_msgs/msg/Bool", "ros2msg", TEXT, "cdr")
SCAN = Topic("/scan", "std_msgs/msg/Bool", "ros2msg", TEXT, "cdr")
BODY = b"\0\1\0\0\1"


class Clock:
    def __init__(self):
        self.now = 1000.0

    def __call__(self):
        return self.now


@pytest.fixture
def keeping():
    clock = Clock()
    found = Keeping(10.0, clock, most_bytes=1_000)
    found.clock = clock
    return found


def test_what_was_said_before_and_after_is_in_the_recording(keeping, tmp_path):
    for second in range(20):
        keeping.clock.now = 1000.0 + second
        keeping.received(STOP, BODY)

    def meanwhile(seconds):
        assert seconds == 5.0
        for second in range(5):
            keeping.clock.now = 1020.0 + second
            keeping.received(SCAN, BODY)

    path = tmp_path / "recordings" / "r.mcap"
    text = keeping.write(str(path), "ros2", 5.0, meanwhile)
    assert text == f"16 messages of 2 topics, 15.0 s long, in {path}"
    bag = open_bag(path)
    assert bag.failures == ()
    assert bag.messages == 16
    assert (bag.start, bag.end) == (1009.0, 1024.0)
    assert {one.name for one in bag.topics} == {"/stop", "/scan"}
    keeping.received(SCAN, BODY)
    assert open_bag(path).messages == 16


def test_memory_is_bounded_and_the_oldest_given_up(keeping, tmp_path):
    for _ in range(50):
        keeping.received(STOP, b"x" * 100)
    assert "10 messages" in keeping.write(str(tmp_path / "r.mcap"), "ros2", 0.0)


def test_what_cannot_be_written_is_a_failure_and_keeping_goes_on(keeping, tmp_path):
    (tmp_path / "there.mcap").write_bytes(b"")
    with pytest.raises(ActionError, match="cannot be written"):
        keeping.write(str(tmp_path / "there.mcap"), "ros2", 0.0)
    keeping.received(STOP, BODY)
    assert "1 message " in keeping.write(str(tmp_path / "r.mcap"), "ros2", 0.0)


def test_threads_may_speak_while_it_is_written(tmp_path):
    keeping = Keeping(10.0)
    ended = threading.Event()

    def speak():
        while not ended.is_set():
            keeping.received(STOP, BODY)

    threads = [threading.Thread(target=speak) for _ in range(3)]
    for one in threads:
        one.start()
    keeping.write(str(tmp_path / "r.mcap"), "ros2", 0.05)
    ended.set()
    for one in threads:
        one.join()
    bag = open_bag(tmp_path / "r.mcap")
    assert bag.failures == ()
    assert bag.messages > 3
