"""Two nodes of ROS 2, for tests of what is counted in them: ros2_pair.py talker|listener MESSAGES CALLS.

Each says in a line of JSON what it counted itself and the CPU seconds that took, and ends when its standard input does.
"""

import json
import resource
import sys
import time

import rclpy
from rcl_interfaces.srv import GetParameters
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.serialization import serialize_message
from std_msgs.msg import Header

ROLE, MESSAGES, CALLS = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
TYPED, RAW = "typed", "raw"
PATIENCE = 30.0


def cpu():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def reported(**counted):
    sys.stdout.write(json.dumps(counted) + "\n")
    sys.stdout.flush()
    sys.stdin.read()


def talk(node):
    typed, raw = (node.create_publisher(Header, topic, QoSProfile(depth=MESSAGES)) for topic in (TYPED, RAW))
    begin = time.monotonic()
    while min(typed.get_subscription_count(), raw.get_subscription_count()) < 1:
        if time.monotonic() - begin > PATIENCE:
            raise SystemExit("nobody listens")
        rclpy.spin_once(node, timeout_sec=0.05)
    size = typed_size = 0
    before = cpu()
    for number in range(MESSAGES):
        message = Header(frame_id=str(number))
        message.stamp = node.get_clock().now().to_msg()
        typed.publish(message)
        typed_size += len(serialize_message(message))
        if number % 2:
            whole = serialize_message(message)
            size += len(whole)
            raw.publish(whole)
        rclpy.spin_once(node, timeout_sec=0.002)
    used = cpu() - before
    begin = time.monotonic()
    served = node.count_clients(f"{node.get_name()}/get_parameters")
    while served and node.count_clients(f"{node.get_name()}/get_parameters") and time.monotonic() - begin < PATIENCE:
        rclpy.spin_once(node, timeout_sec=0.05)
    reported(typed=MESSAGES, raw=MESSAGES // 2, size=size, typed_size=typed_size, cpu=used)


def listen(node):
    taken = {TYPED: 0, RAW: 0, "size": 0}

    def take_typed(_):
        taken[TYPED] += 1

    def take_raw(whole):
        taken[RAW] += 1
        taken["size"] += len(whole)

    node.create_subscription(Header, TYPED, take_typed, QoSProfile(depth=MESSAGES))
    node.create_subscription(Header, RAW, take_raw, QoSProfile(depth=MESSAGES), raw=True)
    client = node.create_client(GetParameters, "talker/get_parameters") if CALLS else None
    begin = time.monotonic()
    while not taken[TYPED] and time.monotonic() - begin < PATIENCE:
        rclpy.spin_once(node, timeout_sec=0.05)
    before = cpu()
    while (taken[TYPED], taken[RAW]) != (MESSAGES, MESSAGES // 2) and time.monotonic() - begin < PATIENCE:
        rclpy.spin_once(node, timeout_sec=0.05)
    used, answers = cpu() - before, 0
    for _ in range(CALLS):
        client.wait_for_service(PATIENCE)
        future = client.call_async(GetParameters.Request(names=["use_sim_time"]))
        rclpy.spin_until_future_complete(node, future, timeout_sec=PATIENCE)
        answers += future.done()
    if client:
        node.destroy_client(client)
    reported(typed=taken[TYPED], raw=taken[RAW], size=taken["size"], answers=answers, cpu=used)


rclpy.init()
one = Node(ROLE)
talk(one) if ROLE == "talker" else listen(one)
one.destroy_node()
rclpy.shutdown()
