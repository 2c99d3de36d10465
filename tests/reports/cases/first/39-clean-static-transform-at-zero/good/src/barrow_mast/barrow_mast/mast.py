import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster


class Mast(Node):

    def __init__(self):
        super().__init__('mast')
        self.broadcaster = StaticTransformBroadcaster(self)
        mast = TransformStamped()
        mast.header.frame_id = 'base_link'
        mast.child_frame_id = 'mast'
        mast.transform.translation.z = 1.4
        mast.transform.rotation.w = 1.0
        self.broadcaster.sendTransform(mast)


def main():
    rclpy.init()
    rclpy.spin(Mast())
    rclpy.shutdown()
