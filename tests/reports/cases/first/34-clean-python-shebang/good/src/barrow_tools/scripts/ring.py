#!/usr/bin/env python
import rospy
from std_msgs.msg import Empty


def main():
    rospy.init_node('ring')
    bell = rospy.Publisher('bell', Empty, queue_size=1)
    rate = rospy.Rate(0.1)
    while not rospy.is_shutdown():
        bell.publish(Empty())
        rate.sleep()


if __name__ == '__main__':
    main()
