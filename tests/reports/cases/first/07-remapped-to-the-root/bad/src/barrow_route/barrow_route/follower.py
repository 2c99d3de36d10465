import rclpy
from nav_msgs.msg import Path
from rclpy.node import Node


class Follower(Node):

    def __init__(self):
        super().__init__('follower')
        self.path = None
        self.subscription = self.create_subscription(Path, '~/input/path', self.on_path, 10)

    def on_path(self, msg):
        self.path = msg


def main():
    rclpy.init()
    rclpy.spin(Follower())
    rclpy.shutdown()
