#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Laser(Node):

    def __init__(self):
        super().__init__('laser')
        self.scan = self.create_publisher(LaserScan, 'scan', qos_profile_sensor_data)
        self.timer = self.create_timer(0.1, self.step)

    def step(self):
        scan = LaserScan()
        scan.header.stamp = self.get_clock().now().to_msg()
        scan.header.frame_id = 'laser'
        self.scan.publish(scan)


def main():
    rclpy.init()
    rclpy.spin(Laser())
    rclpy.shutdown()


if __name__ == '__main__':
    main()
