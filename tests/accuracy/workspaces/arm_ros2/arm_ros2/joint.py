from lifecycle_msgs.srv import GetState
from sensor_msgs.msg import JointState

from rclpy.qos import QoSPresetProfiles


class Joint:
    """A joint on the node of its arm."""

    def __init__(self, node, name):
        self.name = name
        self.publisher = node.create_publisher(JointState, "joints/{}/state".format(name), 5)
        self.service = node.create_service(GetState, "~/joints/" + name + "/get", self.on_get)
        node.create_subscription(JointState, "joints/%s/goal" % name, self.on_goal, QoSPresetProfiles.SENSOR_DATA.value)

    def on_get(self, request, response):
        return response

    def on_goal(self, message):
        self.publisher.publish(message)
