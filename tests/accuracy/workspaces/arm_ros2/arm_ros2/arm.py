"""An arm: joints that publish, services that stop it, parameters that name its topics."""

import rclpy
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    QoSProfile,
    ReliabilityPolicy,
    qos_profile_sensor_data,
    qos_profile_system_default,
)
from rclpy.qos_overriding_options import QoSOverridingOptions
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, String

from arm_ros2.joint import Joint

STATE = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL, reliability=ReliabilityPolicy.RELIABLE)


class Arm(Node):
    def __init__(self):
        super().__init__("arm")
        self.declare_parameter("frame", "base")
        self.declare_parameters("limits", [("speed", 1.0), ("joints", ["shoulder"]), ("count", 3)])
        limit = ParameterDescriptor(floating_point_range=[FloatingPointRange(from_value=0.0, to_value=50.0)])
        rate = self.declare_parameter("rate", 10.0, limit).value
        stop = self.declare_parameter("stop_topic", "stop").get_parameter_value().string_value
        self.joints = [Joint(self, name) for name in ("shoulder", "elbow")]
        self.state = self.create_publisher(String, "~/state", STATE)
        self.raw = self.create_publisher(
            JointState,
            "joint_states",
            qos_profile_sensor_data,
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )
        alive = QoSProfile(depth=5, deadline=Duration(seconds=0.5), lifespan=Duration(seconds=2))
        self.alive = self.create_publisher(Bool, "alive", alive)
        self.create_subscription(Bool, stop, self.on_stop, qos_profile_system_default)
        if self.get_parameter("frame").value != "base":
            self.create_subscription(String, "frames/arm", self.on_stop, 10)
        self.create_timer(1.0 / rate, self.on_time)

    def on_stop(self, message):
        self.state.publish(String(data="stopped"))

    def on_time(self):
        self.raw.publish(JointState())


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(Arm())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
