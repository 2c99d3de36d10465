"""A laser scanner that sees a round room; publishes /scan."""

import array
import math
import sys

from load import Load
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from ros2_run import run
from sensor_msgs.msg import LaserScan

RAYS = 360


class Lidar(Node):
    def __init__(self):
        super().__init__("lidar")
        self.load = Load(sys.argv[1:], rate=25, payload=4 * RAYS)
        rays = self.load.payload // 4
        self.scan = LaserScan(angle_min=-math.pi, angle_max=math.pi, range_max=30.0)
        self.scan.angle_increment = 2 * math.pi / rays
        self.scan.header.frame_id = "laser"
        self.scan.ranges = array.array("f", [4.0] * rays)
        self.publisher = self.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
        self.create_timer(1 / self.load.rate, self.on_time)

    def on_time(self):
        self.load.work()
        self.scan.header.stamp = self.get_clock().now().to_msg()
        self.publisher.publish(self.scan)


if __name__ == "__main__":
    run(Lidar)
