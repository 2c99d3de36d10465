"""Publishes so many counters as the first word says, on topics that begin with the second one."""

import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import UInt32


def main():
    rclpy.init()
    node = rclpy.create_node("count", automatically_declare_parameters_from_overrides=True)
    first = sys.argv[2] if len(sys.argv) > 2 else "count"
    publishers = [node.create_publisher(UInt32, f"{first}_{number}", 1) for number in range(int(sys.argv[1]))]
    node.create_timer(1.0, lambda: [one.publish(UInt32()) for one in publishers])
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
