"""A node that subscribes /scan and gets nothing: `reliable` asks for more than is offered, `type` for another type."""

import importlib
import sys

import rclpy
from rclpy.qos import qos_profile_sensor_data

messages = importlib.import_module("sensor_msgs.msg")
rclpy.init()
node = rclpy.create_node("misfit")
if sys.argv[1] == "reliable":
    node.create_subscription(messages.LaserScan, "/scan", lambda _: None, 10)
else:
    node.create_subscription(messages.Image, "/scan", lambda _: None, qos_profile_sensor_data)
sys.stdout.write("subscribed\n")
sys.stdout.flush()
rclpy.spin(node)
