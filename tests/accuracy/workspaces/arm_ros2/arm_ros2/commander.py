"""Commands what it is told to; its node has no class of its own."""

import sys

import rclpy
from lifecycle_msgs.srv import GetState
from rclpy.executors import ExternalShutdownException
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool

JOINTS = ["shoulder", "elbow"]


def main():
    rclpy.init(args=sys.argv)
    node = rclpy.create_node(
        "commander", allow_undeclared_parameters=True, automatically_declare_parameters_from_overrides=True
    )
    prefix = node.get_parameter_or("prefix").value or "joints"
    stop = node.create_publisher(Bool, "stop", 1)
    goals = {name: node.create_publisher(JointState, f"joints/{name}/goal", 10) for name in JOINTS}
    clients = [node.create_client(GetState, f"arm/joints/{name}/get") for name in JOINTS]
    node.create_timer(1.0, lambda: stop.publish(Bool(data=not goals)))
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
    return len(clients) + len(prefix)


if __name__ == "__main__":
    main()
