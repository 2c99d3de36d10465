"""Runs a node until it is asked to end."""

import rclpy
from rclpy.executors import ExternalShutdownException


def spin(node):
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
