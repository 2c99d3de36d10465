#!/usr/bin/env python3
import argparse

import rospy
from std_msgs.msg import String


def main():
    parser = argparse.ArgumentParser(description='Greets people.')
    parser.add_argument('--text', default='hello')
    options = parser.parse_args()
    rospy.init_node('wave')
    out = rospy.Publisher('greeting', String, queue_size=1)
    rate = rospy.Rate(1)
    while not rospy.is_shutdown():
        out.publish(String(data=options.text))
        rate.sleep()


if __name__ == '__main__':
    main()
