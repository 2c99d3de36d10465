import rclpy
from std_msgs.msg import Empty


def main():
    rclpy.init()
    node = rclpy.create_node('beep')
    beep = node.create_publisher(Empty, 'beep', 10)
    node.create_timer(2.0, lambda: beep.publish(Empty()))
    rclpy.spin(node)
    rclpy.shutdown()
