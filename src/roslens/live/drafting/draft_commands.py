"""Which topics carry commands: what comes for as long as somebody, or something, wants the robot to move.

That such a topic was published at a steady rate while it was observed says that it was driven then, not that it always
is. Its type decides, or its name where the type is also that of measurements (``TwistStamped``).
"""

from __future__ import annotations

import re

WHY = "a command, which comes for as long as it is given"
_ALWAYS = frozenset(
    {
        "geometry_msgs/Twist",
        "sensor_msgs/Joy",
        "sensor_msgs/JoyFeedback",
        "ackermann_msgs/AckermannDrive",
        "ackermann_msgs/AckermannDriveStamped",
        "trajectory_msgs/JointTrajectory",
    }
)
_BY_NAME = frozenset({"geometry_msgs/TwistStamped", "geometry_msgs/PoseStamped", "geometry_msgs/Pose", "std_msgs/Bool"})
_NAME = re.compile(r"(^|[/_])(cmd|command|commands|teleop|joy|goal|target|setpoint)([/_]|\Z)")


def is_command(topic: str, type_: str) -> bool:
    """Return whether a topic of this name and type, of ROS 1 or ROS 2, carries commands."""
    kind = type_.replace("/msg/", "/")
    return kind in _ALWAYS or (kind in _BY_NAME and bool(_NAME.search(topic)))
