"""Where the robot thinks it is: drives as cmd_vel says, publishes odom."""

import rclpy
from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.node import Node

from demo_robot.spin import spin

PERIOD_S = 0.05


class Odometry(Node):
    def __init__(self):
        super().__init__("odometry")
        self.speed = 0.0
        self.pose = PoseStamped()
        self.pose.header.frame_id = "odom"
        self.publisher = self.create_publisher(PoseStamped, "odom", 10)
        self.create_subscription(TwistStamped, "cmd_vel", self.on_command, 10)
        self.create_timer(PERIOD_S, self.on_time)

    def on_command(self, command):
        self.speed = command.twist.linear.x

    def on_time(self):
        self.pose.pose.position.x += self.speed * PERIOD_S
        self.pose.header.stamp = self.get_clock().now().to_msg()
        self.publisher.publish(self.pose)


def main():
    rclpy.init()
    spin(Odometry())


if __name__ == "__main__":
    main()
