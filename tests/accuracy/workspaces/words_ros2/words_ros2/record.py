"""Records topics that are named on the command line, with options as argparse takes them."""

import argparse
import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from rclpy.utilities import remove_ros_args
from std_msgs.msg import String, UInt32


def options(words):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("topics", nargs="+", help="what to record")
    parser.add_argument("--node", default="record", help="name of the node")
    parser.add_argument("-d", "--depth", type=int, default=5)
    parser.add_argument("--fast", action="store_true", help="lose rather than wait")
    parser.add_argument("--count", metavar="TOPIC", default="count", help="where to say how many there were")
    parser.add_argument("--quiet", action="store_true", help="say nothing")
    return parser.parse_args(words)


def main(args=sys.argv[1:]):
    rclpy.init(args=args)
    given = options(remove_ros_args(args=args))
    node = rclpy.create_node(given.node)
    quality = qos_profile_sensor_data if given.fast else QoSProfile(depth=given.depth)
    for topic in given.topics:
        node.create_subscription(String, topic, lambda message: None, quality)
    if not given.quiet:
        count = node.create_publisher(UInt32, given.count, 1)
        node.create_timer(1.0, lambda: count.publish(UInt32()))
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
