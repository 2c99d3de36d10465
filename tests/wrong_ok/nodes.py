"""Nodes of the gate, by role: `nodes.py beats NAME TOPIC HZ`, `nodes.py container COUNT`…; they say what they do."""

import sys
import time

import rclpy
from diagnostic_msgs.srv import SelfTest
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image
from std_msgs.msg import Header, String

ONE = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
TYPES = {"header": Header, "string": String}


def say(text):
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def sends(node, topic, kind, hz, message, qos=10):
    publisher = node.create_publisher(kind, topic, qos)

    def send():
        publisher.publish(message)
        say("sent")

    node.create_timer(1 / float(hz), send)


def beats(name, topic, hz, kind="header"):
    node = rclpy.create_node(name)
    sends(node, topic, TYPES[kind], hz, TYPES[kind]())
    return [node]


def fast():
    node = rclpy.create_node("fast")
    sends(node, "/big", Header, 10, Header(), ONE)
    return [node]


def slow(seconds):
    node = rclpy.create_node("slow")

    def take(_):
        say("took")
        time.sleep(float(seconds))

    node.create_subscription(Header, "/big", take, ONE)
    return [node]


def camera(size):
    node = rclpy.create_node("camera")
    image = Image(data=bytes(int(size)))
    sends(node, "/image", Image, 10, image, ONE)
    return [node]


def hears(name, topic):
    node = rclpy.create_node(name)
    node.create_subscription(Header, topic, lambda _: None, 10)
    return [node]


def container(count):
    return [rclpy.create_node(f"part{number}") for number in range(int(count))]


def named(name):
    return [rclpy.create_node(name)]


def server():
    node = rclpy.create_node("server")
    node.create_service(SelfTest, "/get", lambda _, answer: answer)
    return [node]


def client():
    node = rclpy.create_node("client")
    asking = node.create_client(SelfTest, "/get")

    def ask():
        if asking.service_is_ready():
            asking.call_async(SelfTest.Request())
        say("asked")

    node.create_timer(0.2, ask)
    return [node]


rclpy.init()
executor = SingleThreadedExecutor()
for one in globals()[sys.argv[1]](*sys.argv[2:]):
    executor.add_node(one)
say("up")
executor.spin()
