import rclpy
from rclpy.node import Node
from sensor_msgs.msg import CameraInfo


class Camera(Node):

    def __init__(self):
        super().__init__('camera')
        rate = self.declare_parameter('rate', 15.0).value
        self.info = self.create_publisher(CameraInfo, 'camera_info', 10)
        self.timer = self.create_timer(1.0 / rate, self.on_timer)

    def on_timer(self):
        info = CameraInfo()
        info.header.stamp = self.get_clock().now().to_msg()
        info.header.frame_id = self.get_name()
        self.info.publish(info)


def main():
    rclpy.init()
    node = Camera()
    rclpy.spin(node)
    rclpy.shutdown()


if __name__ == '__main__':
    main()
