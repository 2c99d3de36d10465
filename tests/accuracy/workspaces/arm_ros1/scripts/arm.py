"""An arm: joints that publish, an action that moves it, services that stop it."""

import actionlib
import rospy
from actionlib.msg import TestAction
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool, SetBoolResponse, Trigger, TriggerResponse


class Joint(object):
    def __init__(self, name, topic="~joints/{}/state"):
        self.publisher = rospy.Publisher(topic.format(name), JointState, queue_size=5)
        self.enable = rospy.Service("~joints/" + name + "/enable", SetBool, self.on_enable)

    def on_enable(self, request):
        return SetBoolResponse(success=request.data)


class Arm(object):
    def __init__(self):
        self.frame = rospy.get_param("~frame", "base")
        self.limits = rospy.get_param("~limits/speed", 1.0)
        joints = ["shoulder", "elbow"]
        self.joints = [Joint(name) for name in joints]
        self.state = rospy.Publisher("state", String, queue_size=1, latch=True)
        self.told = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=10)
        rospy.Subscriber(rospy.get_param("~stop_topic", "stop"), Bool, self.on_stop)
        rospy.Service("home", Trigger, self.on_home)
        if rospy.get_param("~calibrate", False):
            rospy.Service("~calibrate", Trigger, self.on_home)
        self.server = actionlib.SimpleActionServer("~move", TestAction, self.on_move, auto_start=False)
        self.server.start()
        rospy.set_param("~ready", True)
        self.timer = rospy.Timer(rospy.Duration(0.5), self.on_time)

    def on_stop(self, message):
        self.state.publish("stopped")

    def on_home(self, request):
        return TriggerResponse(success=True)

    def on_move(self, goal):
        self.server.set_succeeded()

    def on_time(self, event):
        for joint in self.joints:
            joint.publisher.publish(JointState())


if __name__ == "__main__":
    rospy.init_node("arm")
    arm = Arm()
    rospy.spin()
