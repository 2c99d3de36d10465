"""A laser scanner that sees a round room; publishes /scan."""

import math
import sys

import rospy
from load import Load
from sensor_msgs.msg import LaserScan

RAYS = 360


def main():
    load = Load(sys.argv[1:], rate=25, payload=4 * RAYS)
    rospy.init_node("lidar")
    publisher = rospy.Publisher("/scan", LaserScan, queue_size=5)
    rays = load.payload // 4
    scan = LaserScan(angle_min=-math.pi, angle_max=math.pi, angle_increment=2 * math.pi / rays, range_max=30.0)
    scan.header.frame_id = "laser"
    scan.ranges = [4.0] * rays
    rate = rospy.Rate(load.rate)
    while not rospy.is_shutdown():
        load.work()
        scan.header.stamp = rospy.Time.now()
        publisher.publish(scan)
        rate.sleep()


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
