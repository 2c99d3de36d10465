"""The brain: decides from /odom, /scan and /camera/image how fast to drive; publishes /cmd_vel and /planner/status.

A command is computed from an odometry message and carries that message's time stamp, 20 for 50 of them. The status
comes about every third second.
"""

import sys

from geometry_msgs.msg import PoseStamped, TwistStamped
from load import Load
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from ros2_run import run
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import String

ODOMETRY_RATE = 50
STATUS_RATE = 0.3
TOO_CLOSE = 0.5


class Planner(Node):
    def __init__(self):
        super().__init__("planner")
        self.load = Load(sys.argv[1:], rate=20)
        self.nearest = float("inf")
        self.images = 0
        self.due = 0.0
        self.publisher = self.create_publisher(TwistStamped, "/cmd_vel", 10)
        self.status = self.create_publisher(String, "/planner/status", 2)
        self.create_timer(1 / STATUS_RATE, self.on_time)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.create_subscription(Image, "/camera/image", self.on_image, qos_profile_sensor_data)
        self.create_subscription(PoseStamped, "/odom", self.on_odometry, 10)

    def on_scan(self, scan):
        self.nearest = min(scan.ranges)

    def on_image(self, image):
        self.images += 1

    def on_time(self):
        self.status.publish(String(data=f"{self.images} images seen, nearest wall at {self.nearest:.1f} m"))

    def on_odometry(self, pose):
        self.due += self.load.rate / ODOMETRY_RATE
        if self.due < 1:
            return
        self.due -= 1
        self.load.work()
        command = TwistStamped()
        command.header.stamp = pose.header.stamp
        command.twist.linear.x = 0.0 if self.nearest < TOO_CLOSE else 0.3
        self.publisher.publish(command)


if __name__ == "__main__":
    run(Planner)
