"""The brain: decides from /odom, /scan and /camera/image how fast to drive; publishes /cmd_vel and /planner/status.

A command is computed from an odometry message and carries that message's time stamp, 20 for 50 of them. The status
comes about every third second.
"""

import sys

import rospy
from geometry_msgs.msg import PoseStamped, TwistStamped
from load import Load
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import String

ODOMETRY_RATE = 50
STATUS_RATE = 0.3
TOO_CLOSE = 0.5


class Planner:
    def __init__(self, load):
        self.load = load
        self.nearest = float("inf")
        self.images = 0
        self.due = 0.0
        self.publisher = rospy.Publisher("/cmd_vel", TwistStamped, queue_size=10)
        self.status = rospy.Publisher("/planner/status", String, queue_size=2)
        rospy.Timer(rospy.Duration(1 / STATUS_RATE), self.on_time)
        rospy.Subscriber("/scan", LaserScan, self.on_scan, queue_size=5)
        rospy.Subscriber("/camera/image", Image, self.on_image, queue_size=2, buff_size=1 << 20)
        rospy.Subscriber("/odom", PoseStamped, self.on_odometry, queue_size=10)

    def on_scan(self, scan):
        self.nearest = min(scan.ranges)

    def on_image(self, image):
        self.images += 1

    def on_time(self, event):
        self.status.publish(String(data=f"{self.images} images seen, nearest wall at {self.nearest:.1f} m"))

    def on_odometry(self, pose):
        self.due += self.load.rate / ODOMETRY_RATE
        if self.due < 1:
            return
        self.due -= 1
        self.load.work()
        command = TwistStamped()
        command.header.stamp = pose.header.stamp
        command.twist.linear.x = 0.0 if self.nearest < TOO_CLOSE else 0.3
        self.publisher.publish(command)


if __name__ == "__main__":
    rospy.init_node("planner")
    planner = Planner(Load(sys.argv[1:], rate=20))
    rospy.spin()
