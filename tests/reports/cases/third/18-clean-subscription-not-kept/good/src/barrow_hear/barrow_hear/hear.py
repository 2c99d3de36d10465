import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Hear(Node):

    def __init__(self):
        super().__init__('hear')
        self.create_subscription(String, 'said', self.on_said, 10)

    def on_said(self, said):
        self.get_logger().info(said.data)


def main():
    rclpy.init()
    rclpy.spin(Hear())
    rclpy.shutdown()
