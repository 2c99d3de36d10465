"""A laser scanner that sees a round room; publishes scan."""

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from demo_robot.spin import spin


class Lidar(Node):
    def __init__(self):
        super().__init__("lidar")
        self.publisher = self.create_publisher(LaserScan, "scan", qos_profile_sensor_data)
        self.create_timer(0.1, self.on_time)

    def on_time(self):
        scan = LaserScan(angle_min=-3.14, angle_max=3.14, angle_increment=0.1, range_max=30.0, ranges=[4.0] * 63)
        scan.header.frame_id = "laser"
        scan.header.stamp = self.get_clock().now().to_msg()
        self.publisher.publish(scan)


def main():
    rclpy.init()
    spin(Lidar())


if __name__ == "__main__":
    main()
