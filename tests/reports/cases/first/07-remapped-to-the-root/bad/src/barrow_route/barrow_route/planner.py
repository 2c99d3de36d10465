import rclpy
from nav_msgs.msg import Path
from rclpy.node import Node


class Planner(Node):

    def __init__(self):
        super().__init__('planner')
        self.path = self.create_publisher(Path, 'path', 10)
        self.timer = self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        path = Path()
        path.header.stamp = self.get_clock().now().to_msg()
        path.header.frame_id = 'map'
        self.path.publish(path)


def main():
    rclpy.init()
    rclpy.spin(Planner())
    rclpy.shutdown()
