"""Nodes of the gate for ROS 1: `nodes_ros1.py beats NAME TOPIC HZ [TYPE]`, `nodes_ros1.py hears NAME TOPIC [SECONDS]`.

One that hears takes so many seconds for each message, and only the latest one that waits.
"""

import sys
import time

import rospy
from geometry_msgs.msg import PointStamped
from std_msgs.msg import Header, String

TYPES = {"header": Header, "string": String, "point": PointStamped}
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
elif len(sys.argv) > 4:

    def take(_):
        sys.stdout.write("took\n")
        sys.stdout.flush()
        time.sleep(float(sys.argv[4]))

    subscriber = rospy.Subscriber(topic, PointStamped, take, queue_size=1)
else:
    subscriber = rospy.Subscriber(topic, Header, lambda _: None)
sys.stdout.write("up\n")
sys.stdout.flush()
rospy.spin()
