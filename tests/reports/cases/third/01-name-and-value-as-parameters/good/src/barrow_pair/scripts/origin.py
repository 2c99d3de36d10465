#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Origin(Node):

    def __init__(self):
        super().__init__('origin')
        frame = self.declare_parameter('frame', 'local').value
        out = self.create_publisher(String, 'origin_frame', 1)
        out.publish(String(data=frame))


def main():
    rclpy.init()
    rclpy.spin(Origin())
    rclpy.shutdown()


if __name__ == '__main__':
    main()
