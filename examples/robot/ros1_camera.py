"""A camera that sees grey; publishes /camera/image."""

import sys

import rospy
from load import Load
from sensor_msgs.msg import Image

WIDTH = 300


def main():
    load = Load(sys.argv[1:], rate=10, payload=60_000)
    rospy.init_node("camera")
    publisher = rospy.Publisher("/camera/image", Image, queue_size=2)
    height = load.payload // WIDTH
    image = Image(width=WIDTH, height=height, encoding="mono8", step=WIDTH, data=b"\x7f" * (WIDTH * height))
    image.header.frame_id = "camera"
    rate = rospy.Rate(load.rate)
    while not rospy.is_shutdown():
        load.work()
        image.header.stamp = rospy.Time.now()
        publisher.publish(image)
        rate.sleep()


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
