"""A camera that sees grey; publishes /camera/image."""

import array
import sys

from load import Load
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from ros2_run import run
from sensor_msgs.msg import Image

WIDTH = 300


class Camera(Node):
    def __init__(self):
        super().__init__("camera")
        self.load = Load(sys.argv[1:], rate=10, payload=60_000)
        height = self.load.payload // WIDTH
        self.image = Image(width=WIDTH, height=height, encoding="mono8", step=WIDTH)
        self.image.header.frame_id = "camera"
        self.image.data = array.array("B", b"\x7f" * (WIDTH * height))
        self.publisher = self.create_publisher(Image, "/camera/image", qos_profile_sensor_data)
        self.create_timer(1 / self.load.rate, self.on_time)

    def on_time(self):
        self.load.work()
        self.image.header.stamp = self.get_clock().now().to_msg()
        self.publisher.publish(self.image)


if __name__ == "__main__":
    run(Camera)
