"""A node that subscribes /scan and gets nothing: `reliable` asks for more than is offered, `type` for another type."""

import sys

import rclpy
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image, LaserScan  # type: ignore

rclpy.init()
node = rclpy.create_node("misfit")
if sys.argv[1] == "reliable":
    node.create_subscription(LaserScan, "/scan", lambda _: None, 10)
else:
    node.create_subscription(Image, "/scan", lambda _: None, qos_profile_sensor_data)
rclpy.spin(node)
