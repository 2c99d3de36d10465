import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node


class Push(Node):

    def __init__(self):
        super().__init__('push')
        self.far = 0.0
        self.command = self.create_publisher(Twist, 'cmd_vel', 10)
        self.odom = self.create_subscription(Odometry, 'odom', self.on_odom, 10)

    def on_odom(self, odom):
        self.far = odom.pose.pose.position.x


def main():
    rclpy.init()
    node = Push()
    forward = Twist()
    forward.linear.x = 0.2
    while rclpy.ok() and node.far < 1.0:
        node.command.publish(forward)
        rclpy.spin_once(node)
    rclpy.shutdown()
