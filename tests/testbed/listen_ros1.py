"""Counts messages on topics with rospy, as `rostopic hz` does; `tally_messages.py` says what it takes."""

import sys

import rospy
from tally_messages import Tally

if __name__ == "__main__":
    rospy.init_node("listener", anonymous=True, disable_signals=True)
    tally = Tally(sys.argv[1:], lambda message: bytes(message._buff), stamp_at=4)  # a header begins with its number
    for topic in tally.topics:
        rospy.Subscriber(topic, rospy.AnyMsg, tally.counter(topic), buff_size=1 << 20)
    code = tally.report()
    rospy.signal_shutdown("counted")
    sys.exit(code)
