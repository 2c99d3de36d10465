"""The brain: stops in front of walls; reads scan and odom, publishes cmd_vel.

Its parameter `reliable` is whether each scan has to arrive.
"""

import rclpy
from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import LaserScan

from demo_robot.spin import spin

TOO_CLOSE_M = 0.5


class Planner(Node):
    def __init__(self):
        super().__init__("planner")
        self.declare_parameter("reliable", False)
        reliable = self.get_parameter("reliable").value
        policy = ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT
        self.nearest = float("inf")
        self.publisher = self.create_publisher(TwistStamped, "cmd_vel", 10)
        self.create_subscription(LaserScan, "scan", self.on_scan, QoSProfile(depth=10, reliability=policy))
        self.create_subscription(PoseStamped, "odom", self.on_odometry, 10)

    def on_scan(self, scan):
        self.nearest = min(scan.ranges)

    def on_odometry(self, pose):
        command = TwistStamped()
        command.header.stamp = pose.header.stamp
        command.twist.linear.x = 0.0 if self.nearest < TOO_CLOSE_M else 0.3
        self.publisher.publish(command)


def main():
    rclpy.init()
    spin(Planner())


if __name__ == "__main__":
    main()
