import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float64


class Scale(Node):

    def __init__(self):
        super().__init__('scale')
        kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.factor = self.create_publisher(Float64, 'scale_factor', kept)
        self.factor.publish(Float64(data=1.02))


def main():
    rclpy.init()
    rclpy.spin(Scale())
    rclpy.shutdown()
