"""A managed node, and one beside it in the same process."""

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from std_msgs.msg import Bool, Float64


class Gripper(LifecycleNode):
    def __init__(self):
        super().__init__("gripper")
        self.force = self.declare_parameter("force", 5.0)

    def on_configure(self, state):
        self.opening = self.create_lifecycle_publisher(Float64, "opening", 10)
        self.grip = self.create_subscription(Bool, "~/close", self.on_close, 1)
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state):
        return super().on_activate(state)

    def on_close(self, message):
        self.opening.publish(Float64(data=0.0))


class Camera(Node):
    def __init__(self, name="gripper_camera", **kwargs):
        super().__init__(name, **kwargs)
        self.create_subscription(Float64, "opening", lambda message: None, 10)


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    for node in (Gripper(), Camera(namespace="tool")):
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
