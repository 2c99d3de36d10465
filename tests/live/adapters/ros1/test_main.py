import os
import signal
import subprocess
import sys

import pytest

from roslens.live.adapters.ros1.__main__ import DEFAULT_MASTER, main, read_arguments
from roslens.model.wire import FrameReader

pytestmark = pytest.mark.timed


def test_arguments(monkeypatch):
    monkeypatch.delenv("ROS_MASTER_URI", raising=False)
    options = read_arguments(["--tap", "/scan*", "--tap", "/odom", "--tap-budget", "20", "--statistics"])
    assert options.master == DEFAULT_MASTER
    assert [pattern.text for pattern in options.tap] == ["/scan*", "/odom"]
    assert options.tap_budget == 0.2
    assert options.statistics
    assert (options.diagnostics, options.rated) == (False, "")
    options = read_arguments(["--diagnostics", "--rated", "/roslens/rated"])
    assert (options.diagnostics, options.rated) == (True, "/roslens/rated")
    monkeypatch.setenv("ROS_MASTER_URI", "http://robot:11311")
    assert read_arguments([]).master == "http://robot:11311"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--master", "robot:11311"], "not a URI of the form"),
        (["--period", "0"], "not a number from"),
        (["--period", "soon"], "not a number from"),
        (["--tap-budget", "200"], "not a number from"),
        (["--tap", ""], "--tap"),
    ],
)
def test_wrong_arguments_are_told(words, said, capsys):
    with pytest.raises(SystemExit) as caught:
        main(words)
    assert caught.value.code == 2
    assert said in capsys.readouterr().err


@pytest.fixture
def observer(system):
    command = [sys.executable, "-m", "roslens.live.adapters.ros1", "--master", system.master.uri, "--period", "0.05"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        yield process
        process.kill()


def frames(process, wanted):
    reader, seen = FrameReader(), []
    while len(seen) < wanted:
        seen += reader.feed(os.read(process.stdout.fileno(), 65536))
    return seen


def test_frames_come_until_it_is_told_to_stop(system, observer):
    system.node("/a", pid=observer.pid)
    seen = frames(observer, 3)
    assert [frame.sequence for frame in seen[:3]] == [0, 1, 2]
    assert {node.name for frame in seen if frame.graph for node in frame.graph.nodes} == {"/a"}
    assert system.subscribers["/rosout"]
    observer.send_signal(signal.SIGTERM)
    assert observer.wait(10) == 0
    assert observer.stderr.read() == b""
    assert not system.subscribers["/rosout"], "the registration was taken back"


def test_it_ends_when_nobody_reads(system, observer):
    frames(observer, 1)
    observer.stdout.close()
    assert observer.wait(10) == 0
    assert observer.stderr.read() == b""
    assert not system.subscribers["/rosout"]
