#!/usr/bin/env python3
import rclpy
from rclpy.node import Node


class Counter(Node):

    def __init__(self):
        super().__init__('counter')
        self.count = self.declare_parameter('first', 0).value
        self.timer = self.create_timer(1.0, self.step)

    def step(self):
        self.count += 1
        self.get_logger().info(f'{self.count} crates')


def main():
    rclpy.init()
    rclpy.spin(Counter())
    rclpy.shutdown()


if __name__ == '__main__':
    main()
