"""Runs one ROS 2 node until it is asked to end."""

import rclpy
from rclpy.executors import ExternalShutdownException


def run(make_node):
    rclpy.init()
    try:
        rclpy.spin(make_node())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
