import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Caller(Node):

    def __init__(self):
        super().__init__('caller')
        self.client = self.create_client(Trigger, 'unload')
        self.timer = self.create_timer(5.0, self.call)

    def call(self):
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request())


def main():
    rclpy.init()
    rclpy.spin(Caller())
    rclpy.shutdown()
