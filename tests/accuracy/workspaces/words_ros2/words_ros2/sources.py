"""Takes what a list of sources names: each has parameters of its own, which say where it is and how it is heard."""

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSPolicyKind, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions
from std_msgs.msg import Float64, String

HEARD = QoSProfile(depth=3, reliability=ReliabilityPolicy.BEST_EFFORT, deadline=Duration(seconds=2))
MAY = (QoSPolicyKind.RELIABILITY, QoSPolicyKind.DEADLINE)


class Sources(Node):
    def __init__(self):
        super().__init__("sources")
        names = self.declare_parameter("sources", ["front", "rear"]).value
        self.said = []
        for number, name in enumerate(sorted(names)):
            topic = self.declare_parameter(f"{name}.topic", f"{name}/text").value
            may = QoSOverridingOptions(MAY, entity_id="source")
            self.create_subscription(String, topic, self.take, HEARD, qos_overriding_options=may)
            if self.declare_parameter(name + ".weight", 1.0).value:
                self.said.append(self.create_publisher(Float64, "weights/" + name, 1))
        pairs = zip(["low", "high"], [1.0, 2.0])
        self.limits = {name: self.create_publisher(Float64, f"limits/{name}", 1) for name, _ in pairs}

    def take(self, message):
        for publisher in self.said:
            publisher.publish(Float64())


def main():
    rclpy.init()
    try:
        rclpy.spin(Sources())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
