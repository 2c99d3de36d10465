"""Relays from one topic to another, both named on the command line; the second one may be left out."""

import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from std_msgs.msg import String


class Relay(Node):
    def __init__(self, source, target):
        super().__init__("relay")
        self.publisher = self.create_publisher(String, target, 10)
        self.create_subscription(String, source, self.publisher.publish, 10)


def main():
    rclpy.init(args=sys.argv)
    words = remove_ros_args(args=sys.argv)
    if len(words) < 2:
        return "usage: relay SOURCE [TARGET]"
    target = words[2] if len(words) > 2 else words[1] + "_relay"
    try:
        rclpy.spin(Relay(words[1], target))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())
