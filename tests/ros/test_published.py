"""A robot whose talker falls silent: what `roslens watch` says of it is in ROS within a second, in both generations."""

import json
import os
import subprocess
import sys
import threading
import time
from contextlib import contextmanager, suppress

import pytest
from pace import slowness
from ros2_domain import own_domain

from roslens.live.adapters.child import clean_environment

pytestmark = pytest.mark.real

REFERENCE = """
kind: reference
name: demo
constraints:
  - topic: /chatter
    expected: always
    severity: error
    text: Look at the cable.
    grace: 0 s
"""
NAME = "roslens: topic /chatter"
SOON_S = 1.0
BECAUSE = " (because of node:/talker)"
"""Reported from when it is known that the node is gone: with the silence of its topic, or a moment later."""
MAIN = "import sys; from roslens.cli.main import main; sys.exit(main(sys.argv[1:]))"
TALKER1 = """
import rospy
from std_msgs.msg import String
rospy.init_node("talker")
publisher = rospy.Publisher("/chatter", String, queue_size=10)
rate = rospy.Rate(20)
while not rospy.is_shutdown():
    publisher.publish("hello")
    rate.sleep()
"""
HEAR = """
import json, sys, time
def say(*parts):
    sys.stdout.write(json.dumps(parts) + "\\n")  # as one, for rospy calls back from several threads
    sys.stdout.flush()
def heard(message):
    for one in message.status:
        level = one.level if isinstance(one.level, int) else one.level[0]
        values = [[pair.key, pair.value] for pair in one.values]
        say("status", time.time(), one.name, level, one.message, one.hardware_id, values)
def rated(message):
    for one in message.signals:
        say("rated", time.time(), one.name, one.state, one.constraint, one.severity)
"""
LISTENER1 = (
    HEAR
    + """
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from roslens_msgs.msg import RatedSignals
rospy.init_node("listener")
rospy.Subscriber("/diagnostics", DiagnosticArray, heard)
rospy.Subscriber("/roslens/rated", RatedSignals, rated)
rospy.spin()
"""
)
TALKER2 = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("talker")
publisher = node.create_publisher(String, "/chatter", 10)
node.create_timer(0.05, lambda: publisher.publish(String(data="hello")))
rclpy.spin(node)
"""
LISTENER2 = (
    HEAR
    + """
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from roslens_msgs.msg import RatedSignals
rclpy.init()
node = rclpy.create_node("listener")
node.create_subscription(DiagnosticArray, "/diagnostics", heard, 10)
node.create_subscription(RatedSignals, "/roslens/rated", rated, 10)
rclpy.spin(node)
"""
)


class Program:
    """A process, and the lines of JSON that it writes as they come."""

    def __init__(self, words, environment):
        self.process = subprocess.Popen(words, env=environment, stdout=subprocess.PIPE, text=True)
        self.found = []
        self.fresh = threading.Condition()
        self.ended = False
        self.reading = threading.Thread(target=self._read)
        self.reading.start()

    def _read(self):
        with self.process.stdout as lines:
            for line in lines:
                with self.fresh, suppress(json.JSONDecodeError):  # rospy logs there too
                    self.found.append(json.loads(line))
                    self.fresh.notify_all()
        with self.fresh:
            self.ended = True
            self.fresh.notify_all()

    def first(self, fits, seconds=40):
        def there():
            return next((one for one in self.found if fits(one)), None)

        with self.fresh:
            assert self.fresh.wait_for(lambda: there() or self.ended, seconds), self.found[-5:]
            found = there()
            assert found, f"it ended before that: {self.found[-5:]}"
            return found

    def end(self):
        self.process.terminate()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.reading.join()


@contextmanager
def running(*commands):
    """Run commands, each with its environment, and end them."""
    programs = []
    try:
        for words, environment in commands:
            programs.append(Program(words, environment))
        yield programs
    finally:
        for program in reversed(programs):
            program.end()


def watching(tmp_path, *words):
    reference = tmp_path / "demo.yaml"
    reference.write_text(REFERENCE)
    return [
        sys.executable, "-c", MAIN, "watch", *words, "--reference", str(reference), "--format", "json",
        "--diagnostics", "--publish-statistics", "/roslens/rated",
    ]  # fmt: skip


def told_soon(watch, listener, end_talker):
    """Wait until all is well, let the talker end, and check when that is in ROS; return the status."""

    def status(level, since=0.0):
        return listener.first(lambda line: line[0] == "status" and line[1] >= since and line[2:4] == [NAME, level])

    def rated(state, since=0.0):
        return listener.first(lambda line: line[0] == "rated" and line[1] >= since and line[2:4] == ["/chatter", state])

    status(0)
    rated(0)
    ended = time.time()
    end_talker()
    silent = {"is": "verdict", "entity": "topic:/chatter", "state": "absent"}  # not that of the node that is gone
    verdict = watch.first(lambda line: silent.items() <= line.items() and line["time"] > ended)
    bad, signal = status(2, ended), rated(5, ended)
    soon = SOON_S * slowness()
    assert bad[1] - verdict["time"] < soon
    assert signal[1] - verdict["time"] < soon
    assert signal[4:] == ["demo.topic.chatter.presence", 2]
    # Nobody but what the reference is about is judged, our own topics and node least of all; and the node that is gone,
    # as the cause of what is.
    gone = {"roslens: node /talker", "/talker"}
    assert {line[2] for line in listener.found if line[1] < ended} == {NAME, "/chatter"}
    assert {line[2] for line in listener.found} - gone == {NAME, "/chatter"}
    judged = {(line["entity"], line["time"] > ended) for line in watch.found if line["is"] == "verdict"}
    nodes = {line["entity"] for line in watch.found if line["is"] == "event" and line["entity"].startswith("node:")}
    assert judged - {("node:/talker", True)} == {("topic:/chatter", False), ("topic:/chatter", True)}
    assert nodes <= {"node:/talker", "node:/listener"}
    return bad


def test_ros1(master, messages1, tmp_path):
    scripts = {"talker": TALKER1, "listener": LISTENER1}
    for name, text in scripts.items():
        (tmp_path / f"{name}.py").write_text(text)
    python = "/usr/bin/python3"
    nodes = {**master, "PYTHONPATH": str(messages1)}
    with running(
        ([python, str(tmp_path / "talker.py")], nodes),
        ([python, str(tmp_path / "listener.py")], nodes),
        (watching(tmp_path, "--ros1"), {**os.environ, **master}),
    ) as (talker, listener, watch):
        status = told_soon(watch, listener, talker.process.terminate)
        assert status[4].replace(BECAUSE, "") == "is expected but not there; Look at the cable."
        assert ["presence state", "absent"] in status[6]
        # Who comes late is reported at once what stands.
        echo = subprocess.run(
            ["rostopic", "echo", "-n1", "/diagnostics"],
            env=master,
            capture_output=True,
            text=True,
            timeout=30,
            check=True,
        )
        assert 'name: "roslens: topic /chatter"' in echo.stdout
        assert "level: 2" in echo.stdout
        information = subprocess.run(
            ["rostopic", "info", "/diagnostics"], env=master, capture_output=True, text=True, timeout=30, check=True
        )
        assert "Type: diagnostic_msgs/DiagnosticArray" in information.stdout
        watch.end()
        # It takes its registrations back.
        topics = subprocess.run(["rostopic", "list", "-p"], env=master, capture_output=True, text=True, check=True)
        assert "/roslens/rated" not in topics.stdout


def test_ros2(ros2_python, messages2, tmp_path):
    base = clean_environment(os.environ) | {
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_DOMAIN_ID": own_domain(),
        "ROS_LOG_DIR": str(tmp_path / "log"),
        "PYTHONPATH": os.pathsep.join(filter(None, [str(messages2), os.environ.get("PYTHONPATH")])),
    }
    with running(
        ([ros2_python, "-c", TALKER2], base),
        ([ros2_python, "-c", LISTENER2], base),
        (watching(tmp_path, "--ros2", "--python", ros2_python), base),
    ) as (talker, listener, watch):
        status = told_soon(watch, listener, talker.process.kill)
        assert status[4].replace(BECAUSE, "") == "is expected but not there; Look at the cable."
