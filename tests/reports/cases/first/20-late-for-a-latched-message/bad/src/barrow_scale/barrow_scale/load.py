import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64


class Load(Node):

    def __init__(self):
        super().__init__('load')
        self.factor = 1.0
        self.subscription = self.create_subscription(Float64, 'scale_factor', self.on_factor, 1)

    def on_factor(self, msg):
        self.factor = msg.data


def main():
    rclpy.init()
    rclpy.spin(Load())
    rclpy.shutdown()
