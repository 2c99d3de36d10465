"""Nodes of the gate for ROS 1: `nodes_ros1.py beats NAME TOPIC HZ [TYPE]`, `nodes_ros1.py hears NAME TOPIC`."""

import sys

import rospy
from std_msgs.msg import Header, String

TYPES = {"header": Header, "string": String}
role, name, topic = sys.argv[1:4]
rospy.init_node(name)
if role == "beats":
    kind = TYPES[sys.argv[5] if len(sys.argv) > 5 else "header"]
    publisher = rospy.Publisher(topic, kind, queue_size=10)

    def send(_):
        publisher.publish(kind())
        sys.stdout.write("sent\n")
        sys.stdout.flush()

    timer = rospy.Timer(rospy.Duration(1 / float(sys.argv[4])), send)
else:
    subscriber = rospy.Subscriber(topic, Header, lambda _: None)
sys.stdout.write("up\n")
sys.stdout.flush()
rospy.spin()
