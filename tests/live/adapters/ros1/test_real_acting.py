"""The process that acts in ROS 1, against Debian's master and rospy nodes."""

import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest

from roslens.children.safe_path import python_words
from roslens.live.adapters.ros1.master import Master
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.xml_rpc import CallError
from roslens.live.react.ros_line import RosLine
from roslens.model.acting.action_kind import action_kind
from roslens.model.acting.order import Verb

pytestmark = [
    pytest.mark.real,
    pytest.mark.skipif(not shutil.which("rosmaster"), reason="rosmaster is not installed"),
    pytest.mark.skipif(not Path("/usr/share/std_srvs/srv").exists(), reason="ros-std-srvs is not installed"),
]

NODE = """
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TwistStamped
from rosgraph_msgs.msg import Log
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, SetBoolResponse
rospy.init_node('base')
def said(text): print(text, flush=True)
rospy.Subscriber('/stop', Bool, lambda one: said(f'stop {one.data}'))
rospy.Subscriber('/velocity', TwistStamped,
    lambda one: said(f'velocity {one.twist.linear.x} {one.header.stamp.secs > 0}'))
rospy.Subscriber('/rosout', Log, lambda one: one.name.startswith('/roslens') and said(f'log {one.msg} {one.level}'))
rospy.Subscriber('/diagnostics', DiagnosticArray, lambda one: said(f'told {one.status[0].message}'))
rospy.Service('/enable', SetBool, lambda one: SetBoolResponse(one.data, 'as you say'))
rospy.Service('/broken', SetBool, lambda one: None)
said('ready')
rospy.spin()
"""
SPEAKER = [
    "/usr/bin/python3",
    "-c",
    """
import rospy
from std_msgs.msg import Bool
rospy.init_node('speaker')
speaker = rospy.Publisher('/kept_bool', Bool, queue_size=1)
print('speaks', flush=True)
rate = rospy.Rate(100)
while not rospy.is_shutdown():
    speaker.publish(Bool(data=True))
    rate.sleep()
""",
]
SPARE_S = 20.0


class Rover:
    """A master, the node, and what it says."""

    def __init__(self, folder):
        with socket.create_server(("127.0.0.1", 0)) as server:
            self.port = server.getsockname()[1]
        self.uri = f"http://127.0.0.1:{self.port}"
        self.environment = {
            **os.environ,
            "ROS_MASTER_URI": self.uri,
            "ROS_IP": "127.0.0.1",
            "ROS_LOG_DIR": str(folder),
        }
        self.environment.pop("PYTHONPATH", None)
        self.start_master()
        self.process = subprocess.Popen(
            ["/usr/bin/python3", "-c", NODE], env=self.environment, stdout=subprocess.PIPE, text=True
        )
        assert self.heard() == "ready"

    def start_master(self):
        command = ["rosmaster", "--core", "-p", str(self.port)]
        self.master = subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL)
        end = time.monotonic() + SPARE_S
        while time.monotonic() < end:
            asked = Master(self.uri, "/test", Resolver(), 1.0)
            try:
                asked.pid()
                return
            except CallError:
                time.sleep(0.05)
            finally:
                asked.close()
        pytest.fail("the master does not answer")

    def heard(self):
        return self.process.stdout.readline().strip()

    def close(self):
        for process in (self.process, self.master):
            process.send_signal(signal.SIGINT)
            process.wait(SPARE_S)
        self.process.stdout.close()


@pytest.fixture(scope="module")
def line(tmp_path_factory):
    with begun(tmp_path_factory.mktemp("ros")) as found:
        yield found


@pytest.fixture
def own_line(tmp_path):
    """Yield one whose master may end, and with it what it knows of the node."""
    with begun(tmp_path) as found:
        yield found


@contextmanager
def begun(folder):
    rover = Rover(folder)
    code = "from roslens.live.adapters.ros1.acting import main; sys.exit(main(sys.argv[1:]))"
    found = RosLine(1, python_words(sys.executable, code, path=sys.path), rover.environment, time.monotonic)
    found.rover = rover
    yield found
    found.close()
    rover.close()


def reply(line, id_):
    end = time.monotonic() + SPARE_S
    while time.monotonic() < end:
        for one in line.poll():
            if one.id == id_:
                return one
        time.sleep(0.01)
    raise AssertionError(f"no reply to {id_}: {line.said}")


def asked(line, kind, target="", verb=Verb.DO, **arguments):
    reported = action_kind(kind).filled(arguments)
    (line.do if verb is Verb.DO else line.prepare)(f"t/{kind}", kind, target, reported)
    return reply(line, f"t/{kind}")


def test_a_stop_that_was_prepared_arrives(line):
    reported = {"topic": "/stop", "type": "std_msgs/Bool", "fields": {"data": True}}
    assert asked(line, "publish", verb=Verb.PREPARE, **reported).done
    found = asked(line, "publish", **reported)
    assert (found.done, found.text) == (True, "published on /stop to 1 subscriber")
    assert line.rover.heard() == "stop True"


def test_what_repeats_goes_on_until_it_is_cleared(line):
    reported = {"topic": "/stop", "type": "std_msgs/Bool", "fields": {"data": True}, "how": "repeated", "rate": 50}
    assert asked(line, "publish", **reported).done
    assert [line.rover.heard() for _ in range(5)] == ["stop True"] * 5
    line.clear("t/publish")
    velocity = {"topic": "/velocity", "type": "geometry_msgs/TwistStamped", "fields": {"twist": {"linear": {"x": 3}}}}
    assert asked(line, "publish", **velocity).done
    while (heard := line.rover.heard()) == "stop True":
        pass
    assert heard == "velocity 3.0 True"


def test_what_does_not_fit_is_refused_when_it_is_prepared(line):
    assert asked(line, "publish", topic="/stop", type="std_msgs/Bool", fields={"data": True}).done
    assert line.rover.heard() == "stop True"
    reported = {"topic": "/halt", "type": "std_msgs/Bool"}
    for wrong, why in (
        ({"fields": {"date": True}}, "Bool has no field 'date'; expected data"),
        ({"fields": {"data": 1}}, "Bool.data is '1'; expected true or false"),
        ({"type": "std_msgs/Boole"}, "there is no std_msgs/Boole here"),
        ({"topic": "/stop", "type": "std_msgs/Empty"}, "/stop is published with std_msgs/Bool already"),
    ):
        found = asked(line, "publish", verb=Verb.PREPARE, **{**reported, **wrong})
        assert not found.done
        assert why in found.text


def test_a_message_that_nobody_hears_is_a_failure(line):
    found = asked(line, "publish", topic="/nobody", type="std_msgs/Bool", fields={"data": True})
    assert (found.done, "has no subscriber" in found.text) == (False, True)


def test_it_is_said_in_the_log_and_as_a_diagnostic(line):
    found = asked(line, "notify", text="scan is late", level="error")
    assert found.done, found.text
    assert {line.rover.heard(), line.rover.heard()} == {"log scan is late 8", "told scan is late"}


def test_parameters_are_set(line):
    assert asked(line, "set_parameter", "/base", name="speed", value=0.5).done
    assert asked(line, "set_parameter", "/base", name="/shared", value=["a", "b"]).done
    master = Master(line.rover.uri, "/test", Resolver(), 1.0)
    assert (master.parameter("/base/speed"), master.parameter("/shared")) == (0.5, ["a", "b"])
    master.close()


def test_services_are_called(line):
    reported = {"service": "/enable", "type": "std_srvs/SetBool"}
    found = asked(line, "call", **reported, fields={"data": True})
    assert (found.done, found.text) == (True, "/enable answered success: True, message: as you say")
    assert not asked(line, "call", **reported, fields={"data": False}).done, "an answer that says so is a failure"
    assert "has no field" in asked(line, "call", verb=Verb.PREPARE, **reported, fields={"date": True}).text
    found = asked(line, "call", service="/broken", type="std_srvs/SetBool")
    assert "/broken failed" in found.text
    found = asked(line, "call", service="/nobody", type="std_srvs/SetBool", timeout=0.5)
    assert not found.done
    assert not asked(line, "lifecycle", "/base", transition="activate").done


def test_a_master_that_was_started_again_knows_the_publishers(own_line):
    rover = own_line.rover
    assert asked(own_line, "publish", topic="/stop", type="std_msgs/Bool", fields={"data": True}).done
    assert rover.heard() == "stop True"
    rover.master.kill()
    rover.master.wait()
    rover.start_master()
    asked_master = Master(rover.uri, "/test", Resolver(), 1.0)
    end = time.monotonic() + SPARE_S
    while not any(topic == "/stop" for topic, _ in asked_master.state()[0].publishers):
        assert time.monotonic() < end
        time.sleep(0.1)
    asked_master.close()


def test_what_was_said_before_and_after_is_recorded(line, tmp_path):
    from roslens.live.adapters.bag.open_bag import open_bag

    reported = {"topics": ["/kept*"], "before": 60.0}
    speak = subprocess.Popen(SPEAKER, env=line.rover.environment, stdout=subprocess.PIPE, text=True)
    try:
        assert speak.stdout.readline() == "speaks\n"
        assert asked(line, "record", verb=Verb.PREPARE, **reported, after=0.0).done
        path = tmp_path / "r.mcap"
        end = time.monotonic() + SPARE_S
        while True:
            found = asked(line, "record", **reported, after=0.3, path=str(path))
            assert found.done, found.text
            bag = open_bag(path)
            if bag.messages > 10:
                break
            assert time.monotonic() < end
            path.unlink()
    finally:
        speak.kill()
        speak.wait()
        speak.stdout.close()
    assert bag.failures == ()
    assert [(one.name, one.type) for one in bag.topics] == [("/kept_bool", "std_msgs/Bool")]
    assert list(bag.fields({"/kept_bool": ["data"]}))
