"""Answers of tf2 itself, in an interpreter that has it: cases come in as JSON lines, answers go out likewise."""

import json
import sys

import rospy
import tf2_py
from geometry_msgs.msg import TransformStamped


def stamped(one):
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = one["parent"], one["child"]
    message.header.stamp = rospy.Time(*divmod(one["stamp"], 10**9))
    place, turn = message.transform.translation, message.transform.rotation
    place.x, place.y, place.z = one["translation"]
    turn.x, turn.y, turn.z, turn.w = one["rotation"]
    return message


def answered(buffer, target, source, time):
    try:
        found = buffer.lookup_transform_core(target, source, rospy.Time(*divmod(time, 10**9)))
    except (tf2_py.TransformException, ValueError) as error:
        return {"error": type(error).__name__}
    place, turn = found.transform.translation, found.transform.rotation
    return {
        "stamp": found.header.stamp.to_nsec(),
        "translation": [place.x, place.y, place.z],
        "rotation": [turn.x, turn.y, turn.z, turn.w],
    }


for line in sys.stdin:
    case = json.loads(line)
    buffer = tf2_py.BufferCore(rospy.Duration(10))
    for one in case["transforms"]:
        put = buffer.set_transform_static if one["static"] else buffer.set_transform
        put(stamped(one), "truth")
    sys.stdout.write(json.dumps([answered(buffer, *asked) for asked in case["asked"]]) + "\n")
