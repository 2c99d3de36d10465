import sys

import rospy
from std_msgs.msg import String

TOPICS = {"state": String, "/left/state": String}

rospy.init_node("watcher")
for topic, kind in TOPICS.items():
    rospy.Subscriber(topic, kind, lambda message: None, queue_size=2)
log = rospy.Publisher(rospy.resolve_name("~log"), String, queue_size=1)
if len(sys.argv) > 1 and sys.argv[1] == "--verbose":
    rospy.Publisher("~verbose", String, queue_size=1)
rospy.spin()
