"""Where the robot thinks it is: drives as /cmd_vel says, publishes /odom."""

import sys

import rospy
from geometry_msgs.msg import PoseStamped, TwistStamped
from load import Load


class Odometry:
    def __init__(self, load):
        self.load = load
        self.speed = 0.0
        self.pose = PoseStamped()
        self.pose.header.frame_id = "odom"
        self.publisher = rospy.Publisher("/odom", PoseStamped, queue_size=10)
        rospy.Subscriber("/cmd_vel", TwistStamped, self.on_command, queue_size=10)

    def on_command(self, command):
        self.speed = command.twist.linear.x

    def run(self):
        rate = rospy.Rate(self.load.rate)
        while not rospy.is_shutdown():
            self.load.work()
            self.pose.pose.position.x += self.speed / self.load.rate
            self.pose.header.stamp = rospy.Time.now()
            self.publisher.publish(self.pose)
            rate.sleep()


if __name__ == "__main__":
    rospy.init_node("odometry")
    try:
        Odometry(Load(sys.argv[1:], rate=50)).run()
    except rospy.ROSInterruptException:
        pass
