"""Moves the arm, and follows where it is."""

import actionlib
import message_filters
import rospy
import tf2_ros
from actionlib.msg import TestAction
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool

PREFIX = "arm"


def main():
    rospy.init_node("commander", anonymous=True)
    client = actionlib.SimpleActionClient("{}/move".format(PREFIX), TestAction)
    stop = rospy.Publisher("stop", Bool, queue_size=1)
    names = rospy.get_param("~joints", ["shoulder", "elbow"])
    joints = [
        message_filters.Subscriber("%s/joints/%s/state" % (PREFIX, name), JointState) for name in ["shoulder", "elbow"]
    ]
    both = message_filters.ApproximateTimeSynchronizer(joints, 10, 0.1)
    both.registerCallback(lambda *states: stop.publish(Bool(data=len(states) != len(names))))
    fixed = tf2_ros.StaticTransformBroadcaster()
    fixed.sendTransform([TransformStamped()])
    moving = tf2_ros.TransformBroadcaster()
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer)
    rospy.spin()
    del client, moving, listener


if __name__ == "__main__":
    main()
