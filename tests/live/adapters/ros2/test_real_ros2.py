"""Two real nodes in two processes, the observer, and the parent that reads it."""

import os
import signal
import subprocess
import time
from contextlib import contextmanager

import pytest

from roslens.live.adapters.child import Child, clean_environment, find_ros2_python, ros2_command
from roslens.live.inside.environment import environment
from roslens.model.failure import Failure
from roslens.model.graph import Change, Role
from roslens.model.tally import NOTHING, Observer

pytestmark = [pytest.mark.real, pytest.mark.slow]

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
rclpy.spin(node)
"""


class Seen:
    """What the observer has told so far."""

    def __init__(self, child):
        self.child = child
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
            self.poll()
            time.sleep(0.002)

    @property
    def graph(self):
        return next((frame.graph for frame in reversed(self.frames) if frame.graph), None)

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
        "ROS_DOMAIN_ID": str(100 + os.getpid() % 100),
        "ROSLENS_COUNTERS": str(tmp_path / "counters"),
        "ROS_LOG_DIR": str(tmp_path / "log"),
    }
    hooked = base | environment(base)
    child = Child("ros2", ros2_command(python, ["--period", "0.5", *words]), base)
    seen = Seen(child)
    nodes = []
    try:
        seen.poll()
        for code in codes:
            nodes.append(
                subprocess.Popen([python, "-c", code], env=hooked, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            )
        seen.until(lambda: set(names) <= {n for n, node in seen.nodes().items() if node.pid})
        yield seen, nodes
    finally:
        for process in nodes:
            process.kill()
            process.wait()
        child.close()


def steady(tallies, most):
    """Leave the first out, in which the node was starting, and join what follows."""
    counted = [tally for tally in tallies if tally.count][1 : most + 1]
    return sum(tally.count for tally in counted), sum(tally.end - tally.start for tally in counted), counted


def test_names_processes_rates_a_misfit_and_a_crash(ros2_python, tmp_path):
    with robot(ros2_python, tmp_path) as (seen, (talker, listener)):
        connection = ("/demo/talker", "/demo/listener")
        seen.until(lambda: len(seen.tallies(*connection)) >= 9)

        nodes = seen.nodes()
        assert (nodes["/demo/talker"].pid, nodes["/demo/listener"].pid) == (talker.pid, listener.pid)
        assert nodes["/demo/talker"].proofs == ("gid", "memory map")
        assert {process.pid for process in seen.graph.processes} == {talker.pid, listener.pid}
        (publisher,) = (e for e in seen.graph.endpoints if e.name == "/demo/chatter" and e.role is Role.PUBLISHER)
        assert publisher.hash.startswith("RIHS01_")
        assert publisher.qos.reliability == "reliable"

        count, seconds, tallies = steady(seen.tallies(*connection), 7)
        assert count / seconds == pytest.approx(HZ, rel=0.05)
        assert all(0 < tally.latency.mean < 0.05 for tally in tallies)
        assert sum(tally.lost for tally in tallies) == 0
        answered = seen.tallies("/demo/listener", "", topic="/demo/answers")
        assert any(0 < tally.processing.mean < 0.05 for tally in answered if tally.processing != NOTHING)
        assert any("/demo/listener gets nothing of what /demo/talker" in one.what for one in seen.failures)
        assert any("transient_local" in one.what for one in seen.failures)

        talker.send_signal(signal.SIGKILL)
        killed = time.monotonic()
        gone = (Change.VANISHED, "node:/demo/talker")
        seen.until(lambda: any(gone == (e.change, e.entity) for frame in seen.frames for e in frame.events), 5)
        assert seen.times[-1] - killed < 0.5
        assert "/demo/talker" not in seen.nodes()
        assert [frame.sequence for frame in seen.frames] == list(range(len(seen.frames)))


def test_a_tap_counts_what_the_nodes_count(ros2_python, tmp_path):
    with robot(ros2_python, tmp_path, "--tap", "/demo/*", "--tap-budget", "50") as (seen, _):
        tap = ("/demo/talker", "", Observer.TAP)
        seen.until(lambda: len(seen.tallies(*tap)) >= 8)
        tapped = {(t.start, t.end): t for t in seen.tallies(*tap)[1:]}
        assert all(tally.bytes > 0 and 0 <= tally.latency.mean < 0.05 for tally in tapped.values() if tally.count)
        count, seconds, _ = steady(seen.tallies(*tap), 6)
        own, own_seconds, _ = steady(seen.tallies("/demo/talker", ""), 6)
        assert count / seconds == pytest.approx(own / own_seconds, rel=0.05)
        assert sum(tally.lost for tally in tapped.values()) == 0


def test_a_managed_node_tells_its_state(ros2_python, tmp_path):
    with robot(ros2_python, tmp_path, codes=[MANAGED], names=["/demo/arm"]) as (seen, _):
        seen.until(lambda: seen.nodes()["/demo/arm"].lifecycle == "inactive")


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
