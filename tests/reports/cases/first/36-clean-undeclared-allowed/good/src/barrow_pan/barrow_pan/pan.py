import rclpy
from std_msgs.msg import Float64


def main():
    rclpy.init()
    node = rclpy.create_node(
        'pan', allow_undeclared_parameters=True, automatically_declare_parameters_from_overrides=True)
    angle = node.get_parameter('angle').value
    period = node.get_parameter_or('period', rclpy.Parameter('period', value=0.5)).value
    target = node.create_publisher(Float64, 'pan/angle', 10)
    node.create_timer(period, lambda: target.publish(Float64(data=angle)))
    rclpy.spin(node)
    rclpy.shutdown()
