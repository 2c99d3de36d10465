import rclpy
from rclpy.node import Node
from sensor_msgs.msg import JointState


class Joints(Node):

    def __init__(self):
        super().__init__('joints')
        self.names = self.setting('joint_names', ['left_wheel', 'right_wheel'])
        self.states = self.create_publisher(JointState, 'joint_states', 10)
        self.timer = self.create_timer(1.0 / self.setting('rate', 20.0), self.on_timer)

    def setting(self, name, default):
        return self.declare_parameter(name, default).value

    def on_timer(self):
        state = JointState()
        state.header.stamp = self.get_clock().now().to_msg()
        state.name = list(self.names)
        state.position = [0.0] * len(state.name)
        self.states.publish(state)


def main():
    rclpy.init()
    rclpy.spin(Joints())
    rclpy.shutdown()
