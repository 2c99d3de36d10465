#!/usr/bin/env python
import rospy
from std_msgs.msg import Bool


def main():
    rospy.init_node('ready')
    ready = rospy.Publisher('ready', Bool, queue_size=1, latch=True)
    ready.publish(Bool(data=True))
    rospy.spin()


if __name__ == '__main__':
    main()
