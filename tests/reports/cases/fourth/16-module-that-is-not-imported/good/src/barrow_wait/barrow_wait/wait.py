import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Gate:

    def __init__(self, node: Node):
        self.node = node
        self.client = node.create_client(Trigger, 'open_gate')

    def open(self) -> bool:
        if not self.client.wait_for_service(timeout_sec=2.0):
            return False
        future = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self.node, future, timeout_sec=5.0)
        return future.done() and future.result().success
