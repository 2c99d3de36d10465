"""A real node of ROS 2, and the process that acts on it."""

import os
import subprocess
import time

import pytest
from ros2_domain import own_domain

from roslens.live.adapters.child import clean_environment, ros2_command
from roslens.live.react.ros_line import RosLine
from roslens.model.acting.action_kind import action_kind
from roslens.model.acting.order import Verb

pytestmark = [pytest.mark.real, pytest.mark.timed]

NODE = """
import rclpy, sys
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.lifecycle import LifecycleNode
from rclpy.qos import DurabilityPolicy, QoSProfile
from rcl_interfaces.msg import Log
from diagnostic_msgs.msg import DiagnosticArray
from std_msgs.msg import Bool
from geometry_msgs.msg import TwistStamped
rclpy.init()
node = LifecycleNode('base', namespace='/rover')
node.declare_parameter('speed', 1.0)
def said(text): print(text, flush=True)
def heed(topic, said_of_it):
    meeting = SubscriptionEventCallbacks(matched=lambda one: one.current_count_change > 0 and said(f'meets {topic}'))
    node.create_subscription(Bool, topic, lambda one: said(f'{said_of_it} {one.data}'), 10, event_callbacks=meeting)
heed('/stop', 'stop')
heed('/stop_again', 'again')
node.create_subscription(TwistStamped, '/velocity',
    lambda one: said(f'velocity {one.twist.linear.x} {one.header.stamp.sec > 0}'), 10)
node.create_subscription(Log, '/rosout', lambda one: one.name.startswith('_roslens') and said(f'log {one.msg}'), 100)
node.create_subscription(DiagnosticArray, '/diagnostics', lambda one: said(f'told {one.status[0].message}'), 10)
said('ready')
rclpy.spin(node)
"""
SPEAK = """
import rclpy
from std_msgs.msg import Bool
rclpy.init()
node = rclpy.create_node('speaker')
speaker = node.create_publisher(Bool, '/kept_bool', 10)
node.create_timer(0.01, lambda: speaker.publish(Bool(data=True)))
print('speaks', flush=True)
rclpy.spin(node)
"""
SPARE_S = 20.0


class Rover:
    """The node, and what it says."""

    def __init__(self, python, environment):
        self.python, self.environment = python, environment
        self.process = subprocess.Popen(
            [python, "-c", NODE], env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
        assert self.heard() == "ready"

    def heard(self):
        """Return what it heard next."""
        while (said := self._said()).startswith("meets "):
            pass
        return said

    def meets(self, topic):
        """Wait until it is connected with a publisher: before that, nothing arrives."""
        while self._said() != f"meets {topic}":
            assert self.process.poll() is None

    def _said(self):
        return self.process.stdout.readline().strip()

    def close(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


@pytest.fixture(scope="module")
def line(ros2_python):
    environment = clean_environment({**os.environ, "ROS_DOMAIN_ID": own_domain(), "PYTHONDONTWRITEBYTECODE": ""})
    rover = Rover(ros2_python, environment)
    command = ros2_command(ros2_python, [], "roslens.live.adapters.ros2.acting")
    found = RosLine(2, command, environment, time.monotonic)
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
    line.rover.meets("/stop")
    found = asked(line, "publish", **reported)
    assert (found.done, found.text) == (True, "published on /stop to 1 subscriber")
    assert line.rover.heard() == "stop True"


def test_what_repeats_goes_on_until_it_is_cleared(line):
    reported = {"topic": "/stop", "type": "std_msgs/msg/Bool", "fields": {"data": True}, "how": "repeated", "rate": 50}
    assert asked(line, "publish", **reported).done
    assert [line.rover.heard() for _ in range(5)] == ["stop True"] * 5
    line.clear("t/publish")
    marked = {"topic": "/velocity", "type": "geometry_msgs/msg/TwistStamped"}
    velocity = {"fields": {"twist": {"linear": {"x": 3}}}}
    assert asked(line, "publish", **marked, **velocity).done
    while (heard := line.rover.heard()) == "stop True":
        pass
    assert heard == "velocity 3.0 True", "whole numbers are real ones, and headers are stamped"
    assert asked(line, "publish", **marked, fields={}).done
    assert line.rover.heard() == "velocity 0.0 True", "nothing repeats any more"


def test_what_does_not_fit_is_refused_when_it_is_prepared(line):
    reported = {"topic": "/stop", "type": "std_msgs/msg/Bool"}
    for wrong, why in (
        ({"fields": {"date": True}}, "Bool has no field 'date'; expected data"),
        ({"fields": {"data": 1}}, "Bool.data is '1'; expected true or false"),
        ({"type": "std_msgs/msg/Boole"}, "there is no std_msgs/msg/Boole here"),
        ({"type": "os/system"}, "the type 'os/system'"),
        ({"topic": "not a topic"}, "'not a topic'"),
    ):
        found = asked(line, "publish", verb=Verb.PREPARE, **{**reported, **wrong})
        assert not found.done
        assert why in found.text


def test_a_message_that_nobody_hears_is_a_failure(line):
    found = asked(line, "publish", topic="/nobody", type="std_msgs/msg/Bool", fields={"data": True})
    assert (found.done, "has no subscriber" in found.text) == (False, True)


def test_it_is_said_in_the_log_and_as_a_diagnostic(line):
    assert asked(line, "notify", verb=Verb.PREPARE, text="scan is late").done
    found = asked(line, "notify", text="scan is late", level="error")
    assert found.done, found.text
    assert {line.rover.heard(), line.rover.heard()} == {"log scan is late", "told scan is late"}


def test_parameters_are_set_and_refusals_told(line):
    assert asked(line, "set_parameter", "/rover/base", name="speed", value=0.5).done
    found = asked(line, "set_parameter", "/rover/base", name="speed", value="fast")
    assert not found.done
    assert "does not take speed" in found.text
    found = asked(line, "set_parameter", "/nobody", name="speed", value=1.0, timeout=0.3)
    assert "no server offers /nobody/set_parameters" in found.text


def test_managed_nodes_change_their_state(line):
    assert asked(line, "lifecycle", "/rover/base", transition="configure").done
    assert asked(line, "lifecycle", "/rover/base", transition="activate").text.endswith("was inactive and did activate")
    assert not asked(line, "lifecycle", "/rover/base", transition="configure").done
    found = asked(line, "lifecycle", "/rover/base", transition="shutdown")
    assert found.done, found.text


def test_services_are_called(line):
    reported = {"service": "/rover/base/get_parameters", "type": "rcl_interfaces/srv/GetParameters"}
    found = asked(line, "call", **reported, fields={"names": ["use_sim_time"]})
    assert found.done
    assert "bool_value" in found.text
    found = asked(line, "call", verb=Verb.PREPARE, **reported, fields={"names": "use_sim_time"})
    assert "expected a list" in found.text


def test_what_acts_is_started_again_and_knows_what_was_prepared(line):
    reported = {"topic": "/stop_again", "type": "std_msgs/Bool", "fields": {"data": False}}
    assert asked(line, "publish", verb=Verb.PREPARE, **reported).done
    line.rover.meets("/stop_again")
    line._process.kill()
    end = time.monotonic() + SPARE_S
    again = []
    while not again and time.monotonic() < end:
        again = [one for one in line.poll() if one.id == "t/publish" and one.done]
    assert again, line.said
    line.rover.meets("/stop_again")
    assert asked(line, "publish", **reported).done
    assert line.rover.heard() == "again False"


def test_what_was_said_before_and_after_is_recorded(line, tmp_path):
    from roslens.live.adapters.bag.open_bag import open_bag

    reported = {"topics": ["/kept*"], "before": 60.0}
    speak = subprocess.Popen(
        [line.rover.python, "-c", SPEAK], env=line.rover.environment, stdout=subprocess.PIPE, text=True
    )
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
    assert [(one.name, one.type) for one in bag.topics] == [("/kept_bool", "std_msgs/msg/Bool")]
    assert list(bag.fields({"/kept_bool": ["data"]}))
