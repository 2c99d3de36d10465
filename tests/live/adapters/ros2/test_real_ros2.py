"""Two real nodes in two processes, the observer, and the parent that reads it."""

import os
import signal
import subprocess
import time
from contextlib import contextmanager
from statistics import median

import pytest
from ended_early import ended_early
from pace import slowness
from ros2_domain import own_domain

from roslens.live.adapters.child import Child, clean_environment, find_ros2_python, ros2_command
from roslens.live.inside.environment import environment
from roslens.model.failure import Failure
from roslens.model.graph import Change, Role
from roslens.model.traffic.tally import NOTHING, Observer

pytestmark = pytest.mark.real

HZ = 50
START = """
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from std_msgs.msg import Header
rclpy.init()
node = rclpy.create_node({name!r}, namespace='/demo')
{body}
rclpy.spin(node)
"""
TALKER = START.format(name="talker", body="""
publisher = node.create_publisher(Header, 'chatter', 10)
node.create_timer(0.02, lambda: publisher.publish(Header()))
""")  # fmt: skip
LISTENER = START.format(name="listener", body="""
answers = node.create_publisher(String, 'answers', 10)
node.create_subscription(Header, 'chatter', lambda message: answers.publish(String(data='a')), 10)
node.create_subscription(Header, 'chatter', print, QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))
""")  # fmt: skip

MANAGED = """
import rclpy, sys
from rclpy.lifecycle import LifecycleNode
rclpy.init()
node = LifecycleNode('arm', namespace='/demo')
node.trigger_configure()
node.create_timer(4.0, lambda: node.trigger_activate())
rclpy.spin(node)
"""

TELLING = """
import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
rclpy.init()
arm, eye = (rclpy.create_node(name, namespace='/demo') for name in ('arm', 'eye'))
arm.declare_parameter('rate', 10)
arm.declare_parameter('api_key', 'hunter2')
arm.declare_parameter('gains', [0.5, 1.0])
told = eye.create_publisher(DiagnosticArray, '/diagnostics', 10)
turn = 0
def tick():
    global turn
    turn += 1
    arm.set_parameters([Parameter('rate', value=10 + turn // 20), Parameter('api_key', value=f'hunter{turn}')])
    level = DiagnosticStatus.ERROR if turn > 30 else DiagnosticStatus.OK
    told.publish(DiagnosticArray(status=[DiagnosticStatus(level=level, name='motor', message='hot')]))
arm.create_timer(0.2, tick)
executor = SingleThreadedExecutor()
executor.add_node(arm)
executor.add_node(eye)
executor.spin()
"""
TELLS_NO_CHANGES = """
import rclpy
from rclpy.parameter import Parameter
rclpy.init()
node = rclpy.create_node('quiet', namespace='/demo')
node.declare_parameter('rate', 10)
# As a node in C++ does whose option start_parameter_event_publisher is false.
node.destroy_publisher(node._parameter_event_publisher)
class Nobody:
    def publish(self, _):
        pass
node._parameter_event_publisher = Nobody()
node.create_timer(2.0, lambda: node.set_parameters([Parameter('rate', value=90)]))
rclpy.spin(node)
"""
SILENT = """
import rclpy, time
rclpy.init()
node = rclpy.create_node('silent', namespace='/demo')
time.sleep(1000)
"""


class Seen:
    """What the observer has reported so far."""

    def __init__(self, child, nodes):
        self.child = child
        self.nodes_started = nodes
        self.frames = []
        self.failures = []
        self.times = []

    def poll(self):
        for one in self.child.poll(time.monotonic()):
            if isinstance(one, Failure):
                self.failures.append(one)
            else:
                self.frames.append(one)
                self.times.append(time.monotonic())
                self.failures.extend(one.failures)

    def until(self, holds, seconds=30):
        end = time.monotonic() + seconds
        while not holds():
            assert time.monotonic() < end, (self.failures, self.frames[-3:])
            assert not (why := ended_early(self.nodes_started)), why
            self.poll()
            time.sleep(0.002)

    @property
    def graph(self):
        return next((frame.graph for frame in reversed(self.frames) if frame.graph), None)

    def events(self):
        return [event for frame in self.frames for event in frame.events]

    def nodes(self):
        return {node.name: node for node in self.graph.nodes} if self.graph else {}

    def tallies(self, publisher, subscriber, observer=Observer.INSIDE, topic="/demo/chatter"):
        return [
            tally
            for frame in self.frames
            for tally in frame.tallies
            if (tally.topic, tally.publisher, tally.subscriber, tally.observer)
            == (topic, publisher, subscriber, observer)
        ]


@contextmanager
def robot(python, tmp_path, *words, codes=(TALKER, LISTENER), names=("/demo/talker", "/demo/listener")):
    base = clean_environment(os.environ) | {
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_DOMAIN_ID": own_domain(),
        "ROSLENS_COUNTERS": str(tmp_path / "counters"),
        "ROS_LOG_DIR": str(tmp_path / "log"),
    }
    hooked = base | environment(base)
    child = Child("ros2", ros2_command(python, ["--period", "0.5", *words]), base)
    nodes = []
    seen = Seen(child, nodes)
    try:
        seen.poll()
        for number, code in enumerate(codes):
            errors = tmp_path / f"errors_{number}.txt"
            with errors.open("wb") as written:
                started = subprocess.Popen([python, "-c", code], env=hooked, stdout=subprocess.DEVNULL, stderr=written)
            nodes.append((started, errors))
        seen.until(lambda: set(names) <= {n for n, node in seen.nodes().items() if node.pid})
        yield seen, [process for process, _ in nodes]
    finally:
        for process, _ in nodes:
            process.kill()
            process.wait()
        child.close()


def steady(tallies, most):
    """Leave the first out, in which the node was starting, and join the last of what follows."""
    counted = [tally for tally in tallies if tally.count][1:][-most:]
    return sum(tally.count for tally in counted), sum(tally.end - tally.start for tally in counted), counted


def measured(seen, publisher, subscriber, most, **more):
    """The first stretch with the sender's rate: on a busy machine the sender itself stumbles."""

    def kept():
        count, seconds, tallies = steady(seen.tallies(publisher, subscriber, **more), most)
        return len(tallies) == most and count / seconds == pytest.approx(HZ, rel=0.05)

    seen.until(kept, 60)
    return steady(seen.tallies(publisher, subscriber, **more), most)[2]


def test_names_processes_rates_a_misfit_and_a_crash(ros2_python, tmp_path):
    with robot(ros2_python, tmp_path) as (seen, (talker, listener)):
        connection = ("/demo/talker", "/demo/listener")
        tallies = measured(seen, *connection, 7)

        nodes = seen.nodes()
        assert (nodes["/demo/talker"].pid, nodes["/demo/listener"].pid) == (talker.pid, listener.pid)
        assert nodes["/demo/talker"].proofs == ("gid", "memory map")
        assert {process.pid for process in seen.graph.processes} == {talker.pid, listener.pid}
        (publisher,) = (e for e in seen.graph.endpoints if e.name == "/demo/chatter" and e.role is Role.PUBLISHER)
        assert publisher.hash.startswith("RIHS01_")
        assert publisher.qos.reliability == "reliable"

        assert all(tally.latency.mean > 0 for tally in tallies)
        assert median(tally.latency.mean for tally in tallies) < 0.05 * slowness()
        assert sum(tally.lost for tally in tallies) == 0
        answered = seen.tallies("/demo/listener", "", topic="/demo/answers")
        assert any(0 < tally.processing.mean < 0.05 * slowness() for tally in answered if tally.processing != NOTHING)
        assert any("/demo/listener gets nothing of what /demo/talker" in one.what for one in seen.failures)
        assert any("transient_local" in one.what for one in seen.failures)

        talker.send_signal(signal.SIGKILL)
        killed = time.monotonic()
        gone = (Change.VANISHED, "node:/demo/talker")
        seen.until(lambda: any(gone == (e.change, e.entity) for frame in seen.frames for e in frame.events))
        assert seen.times[-1] - killed < 0.5 * slowness()
        assert "/demo/talker" not in seen.nodes()
        assert [frame.sequence for frame in seen.frames] == list(range(len(seen.frames)))


def test_a_tap_counts_what_the_nodes_count(ros2_python, tmp_path):
    with robot(ros2_python, tmp_path, "--tap", "/demo/*", "--tap-budget", "50") as (seen, _):
        tapped = {(t.start, t.end): t for t in measured(seen, "/demo/talker", "", 6, observer=Observer.TAP)}
        assert all(tally.bytes > 0 and tally.latency.mean >= 0 for tally in tapped.values())
        assert median(tally.latency.mean for tally in tapped.values()) < 0.05 * slowness()
        assert measured(seen, "/demo/talker", "", 6)
        assert sum(tally.lost for tally in tapped.values()) == 0


def test_a_managed_node_tells_its_state(ros2_python, tmp_path):
    with robot(ros2_python, tmp_path, codes=[MANAGED], names=["/demo/arm"]) as (seen, _):
        seen.until(lambda: seen.nodes()["/demo/arm"].lifecycle == "inactive")

        states = ("inactive is now active", "node:/demo/arm")
        seen.until(lambda: any((event.detail, event.entity) == states for event in seen.events()))
        assert seen.nodes()["/demo/arm"].lifecycle == "active"


def test_nodes_of_one_process_tell_parameters_and_diagnostics(ros2_python, tmp_path):
    nodes = ("/demo/arm", "/demo/eye")
    with robot(ros2_python, tmp_path, codes=[TELLING, SILENT], names=(*nodes, "/demo/silent")) as (seen, processes):
        seen.until(lambda: set(nodes) <= seen.graph.parameters.keys())
        assert {seen.nodes()[name].pid for name in nodes} == {processes[0].pid}
        assert sum(process.pid == processes[0].pid for process in seen.graph.processes) == 1
        publishers = {end.node for end in seen.graph.endpoints if (end.name, end.role) == ("/rosout", Role.PUBLISHER)}
        assert publishers == {*nodes, "/demo/silent"}
        assert "/demo/silent" not in seen.graph.parameters

        arm = seen.graph.parameters["/demo/arm"]
        assert (arm["gains"], arm["use_sim_time"], arm["api_key"]) == ("[0.5, 1.0]", "false", "***")
        before = int(arm["rate"])
        seen.until(lambda: any(event.entity == "parameter:/demo/arm/rate" for event in seen.events()))
        changed = [event.detail for event in seen.events() if event.entity == "parameter:/demo/arm/rate"]
        old, *words, new = changed[0].split()
        assert (words, int(new)) == (["is", "now"], int(old) + 1)
        seen.until(lambda: any("'motor' is ERROR, was OK: hot" in event.detail for event in seen.events()))
        seen.until(lambda: int(seen.graph.parameters["/demo/arm"]["rate"]) > before)
        reported = [event for event in seen.events() if event.detail.startswith("diagnostics: ")]
        assert [event.entity for event in reported] == ["node:/demo/eye"]
        shown = [frame.graph.parameters for frame in seen.frames if frame.graph]
        assert "hunter" not in repr((shown, seen.events(), seen.failures))


def test_a_parameter_is_followed_whose_node_publishes_no_changes(ros2_python, tmp_path):
    with robot(ros2_python, tmp_path, codes=[TELLS_NO_CHANGES], names=["/demo/quiet"]) as (seen, _):
        seen.until(lambda: seen.graph.parameters.get("/demo/quiet", {}).get("rate") == "90")
        # Where the observer came late, it knew no other value.
        seen.until(lambda: any("/demo/quiet does not publish /parameter_events" in one.what for one in seen.failures))


def test_the_python_is_found(ros2_python):
    assert find_ros2_python(ros2_python, os.environ) == ros2_python


@pytest.mark.parametrize("words", [["--domain", "233"], ["--period", "0"], ["--tap-budget", "0"], ["--tap"]])
def test_wrong_words_are_refused_with_what_is_expected(ros2_python, words):
    ended = subprocess.run(
        ros2_command(ros2_python, words), env=clean_environment(os.environ), capture_output=True, text=True, timeout=60
    )
    assert ended.returncode == 2
    assert "expected" in ended.stderr
    assert ended.stdout == ""
