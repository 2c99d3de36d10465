import rclpy
from std_msgs.msg import Empty


def main():
    rclpy.init()
    node = rclpy.create_node('bell')
    bell = node.create_publisher(Empty, 'bell', 10)
    node.create_timer(60.0, lambda: bell.publish(Empty()))
    rclpy.spin(node)
    rclpy.shutdown()
