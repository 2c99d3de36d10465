"""Nodes that a reference is drafted from: `nodes.py ROLE [NAME]`; what is wrong with them is what $WRONG/ROLE says."""

import json
import os
import random
import sys
import time
from pathlib import Path

import rclpy
from diagnostic_msgs.srv import SelfTest
from rclpy.executors import SingleThreadedExecutor
from rclpy.lifecycle import Node as ManagedNode
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu
from std_msgs.msg import String

BEST_EFFORT = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
HZ = 20


class Wrong:
    """What is wrong now, read again twenty times a second."""

    def __init__(self, node):
        self.file = Path(os.environ["WRONG"], sys.argv[1])
        self.now = {}
        self.kept = []
        node.create_timer(1 / HZ, self.look)

    def look(self):
        try:
            self.now = json.loads(self.file.read_text())
        except (FileNotFoundError, ValueError):
            return
        end = time.process_time() + self.now.get("burn", 0) / HZ
        while time.process_time() < end:
            pass
        if self.now.get("leak"):
            self.kept.append(os.urandom(int(self.now["leak"] * 1e6 / HZ)))
        else:
            self.kept.clear()


class Imus:
    """Publishes at a rate, as far as nothing is wrong."""

    def __init__(self, node, wrong, topic, qos=BEST_EFFORT):
        self.node, self.wrong, self.held, self.number = node, wrong, [], 0
        self.publisher = node.create_publisher(Imu, topic, qos)
        node.create_timer(1 / HZ, self.send)

    def send(self):
        now, self.number = self.wrong.now, self.number + 1
        left_out = (now.get("half") and self.number % 2) or random.random() < now.get("loss", 0)
        if not now.get("mute") and not left_out:
            message = Imu()
            message.header.stamp = self.node.get_clock().now().to_msg()
            self.held.append((time.monotonic() + now.get("late", 0), message))
        while self.held and self.held[0][0] <= time.monotonic():
            self.publisher.publish(self.held.pop(0)[1])


def scanner(name="scanner", topic="/imu"):
    node = rclpy.create_node(name)
    wrong = Wrong(node)
    node.declare_parameter("gain", 2)

    def gain():
        if node.get_parameter("gain").value != wrong.now.get("gain", 2):
            node.set_parameters([Parameter("gain", value=wrong.now.get("gain", 2))])

    node.create_timer(0.1, gain)
    node.imus = Imus(node, wrong, topic)
    return node


def listener():
    node = rclpy.create_node("listener")
    wrong = Wrong(node)
    node.create_subscription(Imu, "/imu", lambda _: time.sleep(wrong.now.get("slow", 0)), BEST_EFFORT)
    return node


def strict():
    """Ask for what the publisher does not offer."""
    node = rclpy.create_node("strict")
    node.create_subscription(Imu, "/imu", lambda _: None, 10)
    return node


def other():
    """Publish another type on the topic."""
    node = rclpy.create_node("other")
    publisher = node.create_publisher(String, "/imu", 10)
    node.create_timer(0.1, lambda: publisher.publish(String()))
    return node


def server():
    node = rclpy.create_node("server")
    wrong = Wrong(node)

    def serve(_, answer):
        time.sleep(wrong.now.get("slow", 0))
        return answer

    node.create_service(SelfTest, "/get", serve)
    return node


def client():
    node = rclpy.create_node("client")
    asking = node.create_client(SelfTest, "/get")
    node.create_timer(0.2, lambda: asking.service_is_ready() and asking.call_async(SelfTest.Request()))
    return node


def managed():
    node = ManagedNode("managed")
    wrong = Wrong(node)
    publisher = node.create_lifecycle_publisher(Imu, "/pose", 10)

    def send():
        if publisher.is_activated:
            publisher.publish(Imu())

    def state():
        active = publisher.is_activated
        if active and wrong.now.get("inactive"):
            node.trigger_deactivate()
        elif not active and not wrong.now.get("inactive"):
            node.trigger_activate()

    node.trigger_configure()
    node.trigger_activate()
    node.create_timer(1 / HZ, send)
    node.create_timer(0.1, state)
    return node


rclpy.init()
executor = SingleThreadedExecutor()
made = globals()[sys.argv[1]](*sys.argv[2:])
executor.add_node(made)
sys.stdout.write("up\n")
sys.stdout.flush()
executor.spin()
