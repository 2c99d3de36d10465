"""Where the robot thinks it is: drives as /cmd_vel says, publishes /odom."""

import sys

from geometry_msgs.msg import PoseStamped, TwistStamped
from load import Load
from rclpy.node import Node
from ros2_run import run


class Odometry(Node):
    def __init__(self):
        super().__init__("odometry")
        self.load = Load(sys.argv[1:], rate=50)
        self.speed = 0.0
        self.pose = PoseStamped()
        self.pose.header.frame_id = "odom"
        self.publisher = self.create_publisher(PoseStamped, "/odom", 10)
        self.create_subscription(TwistStamped, "/cmd_vel", self.on_command, 10)
        self.create_timer(1 / self.load.rate, self.on_time)

    def on_command(self, command):
        self.speed = command.twist.linear.x

    def on_time(self):
        self.load.work()
        self.pose.pose.position.x += self.speed / self.load.rate
        self.pose.header.stamp = self.get_clock().now().to_msg()
        self.publisher.publish(self.pose)


if __name__ == "__main__":
    run(Odometry)
