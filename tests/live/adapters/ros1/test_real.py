"""The observer against Debian's ROS 1: a real master, rospy and roscpp nodes."""

import os
import selectors
import shutil
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from ended_early import ended_early
from pace import slowness

from roslens.live import inside
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.xml_rpc import Caller, CallError
from roslens.model.graph import Change, Role
from roslens.model.traffic.tally import Observer
from roslens.model.wire import FrameReader

PYTHON = "/usr/bin/python3"
RELAY = Path("/usr/lib/topic_tools/relay")

pytestmark = [
    pytest.mark.real,
    pytest.mark.skipif(not shutil.which("roscore"), reason="roscore is not installed"),
]

TALKER = """
import sys, rospy
from std_msgs.msg import Header
rospy.init_node(sys.argv[1])
publisher = rospy.Publisher(sys.argv[2], Header, queue_size=100)
rate = rospy.Rate(float(sys.argv[3]))
while not rospy.is_shutdown():
    publisher.publish(Header(stamp=rospy.Time.now(), frame_id="x" * 10))
    rate.sleep()
"""
SIZE = 4 + 8 + 4 + 10
LOOK_S = 0.2
"""How often nodes are looked at whether they still run."""
LISTENER = """
import sys, rospy
from std_msgs.msg import Header
rospy.init_node(sys.argv[1])
rospy.Subscriber(sys.argv[2], Header, lambda message: None)
rospy.spin()
"""


TELLING = """
import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
rospy.init_node("telling")
rospy.set_param("~gain", 0.5)
rospy.set_param("~api_key", "hunter2")
told = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=10)
rate, turn = rospy.Rate(10), 0
while not rospy.is_shutdown():
    turn += 1
    if turn % 10 == 0:
        rospy.set_param("/shared/count", turn // 10)
    if turn == 50:
        rospy.delete_param("~gain")
    level = DiagnosticStatus.ERROR if turn > 30 else DiagnosticStatus.OK
    told.publish(DiagnosticArray(status=[DiagnosticStatus(level=level, name="motor", message="hot")]))
    rate.sleep()
"""


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as server:
        return server.getsockname()[1]


class Ros:
    """A master and nodes that end with the test."""

    def __init__(self, folder):
        self.folder = folder
        self.port = free_port()
        self.master = f"http://127.0.0.1:{self.port}"
        self.environment = {
            **os.environ,
            "ROS_MASTER_URI": self.master,
            "ROS_IP": "127.0.0.1",
            "ROS_HOME": str(folder / "home"),
            "ROS_LOG_DIR": str(folder / "log"),
        }
        self.environment.pop("PYTHONPATH", None)
        self.started = []
        self.nodes = []
        self.core = self.start_core()

    def start_core(self):
        self.core = self.start("roscore", "-p", str(self.port))
        caller = Caller(self.master, Resolver(), 1.0)
        end = time.monotonic() + 30
        while time.monotonic() < end:
            try:
                if any(name == "/rosout_agg" for name, _ in caller.call("getSystemState", "/test")[2][0]):
                    break
            except CallError:
                pass
            assert self.core.poll() is None, "roscore ended"
            selectors.DefaultSelector().select(0.05)
        else:
            pytest.fail("roscore does not answer")
        caller.close()
        return self.core

    def start(self, *command, **environment):
        errors = self.folder / f"errors_{len(self.started)}.txt"
        with errors.open("wb") as written:
            process = subprocess.Popen(
                command,
                env={**self.environment, **environment},
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=written,
                start_new_session=True,
            )
        self.started.append(process)
        self.nodes.append((process, errors))
        return process

    def python(self, text, *arguments, **environment):
        script = self.folder / f"node_{len(self.started)}.py"
        script.write_text(text)
        return self.start(PYTHON, str(script), *arguments, **environment)

    def end(self, process, number=signal.SIGINT):
        self.nodes = [one for one in self.nodes if one[0] is not process]
        process.send_signal(number)
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def close(self):
        for process in reversed(self.started):
            if process.poll() is None:
                self.end(process)


@pytest.fixture
def ros(tmp_path):
    system = Ros(tmp_path)
    yield system
    system.close()


class Observer1:
    """The observer's process and the frames it speaks."""

    def __init__(self, ros, *options):
        words = ["--master", ros.master, "--period", "0.5", *options]
        command = [sys.executable, "-m", "roslens.live.adapters.ros1", *words]
        self._ros = ros
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE)
        self._reader = FrameReader()
        self.frames = []
        self.graph = None

    def until(self, wanted, seconds=60.0):
        """Read frames until one is wanted; return it."""
        end = time.monotonic() + seconds
        with selectors.DefaultSelector() as ready:
            ready.register(self.process.stdout, selectors.EVENT_READ)
            while time.monotonic() < end:
                if why := ended_early(self._ros.nodes):
                    pytest.fail(why)
                if not ready.select(LOOK_S):
                    continue
                piece = os.read(self.process.stdout.fileno(), 65536)
                assert piece, "the observer ended"
                for frame in self._reader.feed(piece):
                    self.frames.append(frame)
                    self.graph = frame.graph or self.graph
                    if wanted(frame):
                        return frame
        pytest.fail(f"not seen in {seconds} s; last frames: {self.frames[-2:]}")
        return None

    def until_graph(self, *names):
        self.until(lambda frame: self.graph and {node.name for node in self.graph.nodes} >= set(names))
        return self.graph

    def close(self):
        self.process.terminate()
        self.process.wait(10)
        self.process.stdout.close()


@pytest.fixture
def observe(ros):
    made = []

    def make(*options):
        made.append(Observer1(ros, *options))
        return made[-1]

    yield make
    for observer in made:
        observer.close()
        assert observer.process.returncode == 0


def traffic(frames, topic, publisher, subscriber, observer=Observer.PROTOCOL):
    key = (topic, publisher, subscriber, observer)
    return [t for frame in frames for t in frame.tallies if (t.topic, t.publisher, t.subscriber, t.observer) == key]


def measured(observer, count, *key, rate, rel=0.05):
    """Tallies of the first stretch of `count` with the sender's rate: on a busy machine the sender itself stumbles."""
    tallies = []

    def kept(_):
        tallies[:] = traffic(observer.frames, *key)[1:][-count:]
        if len(tallies) < count:
            return False
        return sum(t.count for t in tallies) / sum(t.end - t.start for t in tallies) == pytest.approx(rate, rel=rel)

    observer.until(kept, 90)
    return tallies


def test_rospy_and_roscpp_nodes_are_seen_as_they_are(ros, observe):
    talker = ros.python(TALKER, "talker", "/chat", "50")
    listener = ros.python(LISTENER, "listener", "/chat")
    pids = {"/talker": talker.pid, "/listener": listener.pid}
    if RELAY.exists():
        pids["/relay"] = ros.start(str(RELAY), "/chat", "/again", "__name:=relay").pid
        ros.python(LISTENER, "second", "/again")
    observer = observe()
    graph = observer.until_graph(*pids, "/rosout")
    found = {node.name: node.pid for node in graph.nodes}
    assert {name: found[name] for name in pids} == pids
    assert not [node.name for node in graph.nodes if "roslens" in node.name]
    observer.until(lambda frame: len([end for end in observer.graph.endpoints if end.name == "/chat"]) >= len(pids))
    ends = {(end.node, end.role, end.type) for end in observer.graph.endpoints if end.name == "/chat"}
    assert ends >= {
        ("/talker", Role.PUBLISHER, "std_msgs/Header"),
        ("/listener", Role.SUBSCRIPTION, "std_msgs/Header"),
    }
    tallies = measured(observer, 5, "/chat", "/talker", "/listener", rate=50)
    assert sum(t.bytes for t in tallies) / sum(t.count for t in tallies) == pytest.approx(SIZE, rel=0.05)
    if RELAY.exists():
        for key in (("/chat", "/talker", "/relay"), ("/again", "/relay", "/second")):
            tallies = measured(observer, 5, *key, rate=50)
            assert sum(t.bytes for t in tallies) / sum(t.count for t in tallies) == pytest.approx(SIZE, rel=0.05)
    for frame in observer.frames:
        keys = [(t.topic, t.publisher, t.subscriber) for t in frame.tallies]
        assert len(keys) == len(set(keys)), "no connection is counted twice"


def test_a_node_that_lacks_something_is_told_at_once(ros, observe):
    observer = observe()
    observer.until_graph("/rosout")
    ros.python("import rospy, not_installed.msg")
    begun = time.monotonic()
    with pytest.raises(pytest.fail.Exception, match="No module named 'not_installed'"):
        observer.until_graph("/nobody")
    assert time.monotonic() - begun < 20 * slowness()


def test_a_killed_node_is_noticed_at_once_and_a_new_one_of_its_name_found(ros, observe):
    talker = ros.python(TALKER, "talker", "/chat", "20")
    observer = observe("--period", "5")
    observer.until_graph("/talker")
    observer.until(lambda frame: frame.sequence > 1)
    killed = time.time()
    talker.kill()
    talker.wait()
    frame = observer.until(lambda frame: any(event.entity == "node:/talker" for event in frame.events))
    event = next(event for event in frame.events if event.entity == "node:/talker")
    assert (event.change, event.detail) == (Change.VANISHED, "registered, but its API refuses connections")
    assert event.time - killed < 0.5 * slowness()
    again = ros.python(TALKER, "talker", "/chat", "20")
    graph = observer.until_graph("/talker")
    assert {node.name: node.pid for node in graph.nodes}["/talker"] == again.pid


def test_a_clean_exit_and_a_start_are_told_by_the_master(ros, observe):
    observer = observe("--period", "5")
    observer.until_graph("/rosout")
    talker = ros.python(TALKER, "talker", "/chat", "20")
    observer.until_graph("/talker")
    ros.end(talker)
    frame = observer.until(
        lambda frame: any(e.entity == "node:/talker" and e.change is Change.VANISHED for e in frame.events)
    )
    assert frame.graph


def test_a_master_that_is_restarted_is_picked_up(ros, observe):
    ros.python(TALKER, "talker", "/chat", "20")
    observer = observe()
    observer.until_graph("/talker", "/rosout")
    ros.end(ros.core)
    observer.until(lambda frame: any("is gone" in failure.what for failure in frame.failures))
    assert "/talker" in {node.name for node in observer.graph.nodes}, "it lives on without a master"
    ros.start_core()
    frame = observer.until(lambda frame: any("was restarted" in event.detail for event in frame.events))
    assert ["does not know /talker, which run on" in one.what for one in frame.failures] == [True]
    assert "/talker" in {node.name for node in observer.graph.nodes}
    ros.python(TALKER, "fresh", "/chat", "20")
    observer.until_graph("/fresh", "/rosout")


def test_no_trace_is_left_at_the_master(ros, observe):
    observer = observe()
    observer.until_graph("/rosout")
    caller = Caller(ros.master, Resolver())
    assert "/roslens_" in str(caller.call("getSystemState", "/test"))
    observer.close()
    assert "/roslens_" not in str(caller.call("getSystemState", "/test"))
    caller.close()


SENDER = """
import sys, rospy
from geometry_msgs.msg import PointStamped
rospy.init_node("sender")
publisher = rospy.Publisher("/point", PointStamped, queue_size=100)
rate = rospy.Rate(40)
while not rospy.is_shutdown():
    message = PointStamped()
    message.header.stamp = rospy.Time.now() - rospy.Duration(0.25)
    publisher.publish(message)
    rate.sleep()
"""
TAKER = """
import rospy
from geometry_msgs.msg import PointStamped
rospy.init_node("taker")
rospy.Subscriber("/point", PointStamped, lambda message: None)
rospy.spin()
"""
POINT_SIZE = 16 + 24


def test_a_tap_reads_rate_age_and_loss_and_is_no_part_of_the_system(ros, observe):
    ros.python(SENDER)
    observer = observe("--tap", "/po*")
    tallies = measured(observer, 5, "/point", "/sender", "", Observer.TAP, rate=40)
    count = sum(t.count for t in tallies)
    assert sum(t.bytes for t in tallies) == count * POINT_SIZE
    assert sum(t.period.total for t in tallies) / sum(t.period.count for t in tallies) == pytest.approx(1 / 40, rel=0.1)
    assert sum(t.age.total for t in tallies) / count == pytest.approx(0.25, abs=0.05)
    assert sum(t.lost for t in tallies) == 0
    assert not traffic(observer.frames, "/rosout", "/sender", "", Observer.TAP)
    assert not [t for frame in observer.frames for t in frame.tallies if "roslens" in t.subscriber]


@pytest.mark.parametrize("light", [True, pytest.param(False, marks=pytest.mark.nightly)])
def test_statistics_of_subscribers_are_read(ros, observe, light):
    if light:
        environment = {"PYTHONPATH": str(Path(inside.__file__).parent / "path")}
    else:
        environment = {}
        caller = Caller(ros.master, Resolver())
        caller.call("setParam", "/test", "/enable_statistics", True)
        caller.call("setParam", "/test", "/statistics_window_max_size", 1)
        caller.close()
    ros.python(SENDER)
    ros.python(TAKER, **environment)
    observer = observe("--statistics")
    tallies = measured(observer, 3, "/point", "/sender", "/taker", Observer.INSIDE, rate=40, rel=0.1)
    count = sum(t.count for t in tallies)
    assert sum(t.bytes for t in tallies) / count == pytest.approx(POINT_SIZE, rel=0.1)
    assert sum(t.age.total for t in tallies) / count == pytest.approx(0.25, abs=0.05)
    assert sum(t.lost for t in tallies) == 0


def test_silence_is_told_by_the_light_logger(ros, observe):
    sender = ros.python(SENDER)
    ros.python(TAKER, PYTHONPATH=str(Path(inside.__file__).parent / "path"))
    observer = observe("--statistics")
    measured(observer, 1, "/point", "/sender", "/taker", Observer.INSIDE, rate=40, rel=0.5)
    sender.send_signal(signal.SIGSTOP)
    key = ("/point", "/sender", "/taker", Observer.INSIDE)
    observer.until(lambda frame: any(t.count == 0 for t in traffic([frame], *key)))
    sender.send_signal(signal.SIGCONT)


def test_parameters_and_diagnostics(ros, observe):
    observer = observe("--parameters", "--reports")
    observer.until(lambda frame: observer.graph and "/rosversion" in observer.graph.parameters.get("", ()))
    ros.python(TELLING)
    events = lambda: [event for frame in observer.frames for event in frame.events]  # noqa: E731
    reported = lambda entity: [(one.change, one.detail) for one in events() if one.entity == entity]  # noqa: E731
    observer.until(lambda frame: (Change.VANISHED, "was 0.5") in reported("parameter:/telling/gain"))
    assert reported("parameter:/telling/gain") == [(Change.APPEARED, "is 0.5"), (Change.VANISHED, "was 0.5")]
    assert reported("parameter:/telling/api_key") == [(Change.APPEARED, "is ***")]
    counted = reported("parameter:/shared/count")
    assert counted[0][0] is Change.APPEARED
    assert {change for change, _ in counted[1:]} == {Change.CHANGED}
    assert any(detail == "diagnostics: 'motor' is ERROR, was OK: hot" for _, detail in reported("node:/telling"))
    observer.until(lambda frame: "gain" not in observer.graph.parameters.get("/telling", {"gain": ""}))
    assert observer.graph.parameters["/telling"] == {"api_key": "***"}
    assert {"/rosdistro", "/rosversion", "/shared/count"} <= observer.graph.parameters[""].keys()
    assert "hunter2" not in repr(observer.frames)
