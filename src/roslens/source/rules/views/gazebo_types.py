"""Which types of ROS the bridge to Gazebo converts, and into which of Gazebo (ros_gz_bridge, ``mappings.py``)."""

from __future__ import annotations

import re
from difflib import get_close_matches
from functools import cache

from roslens.source.extract.interfaces.published_interfaces import published_interface
from roslens.source.extract.interfaces.standard_interfaces import STANDARD

_PAIRS = {
    "builtin_interfaces": "Time:Time",
    "geometry_msgs": "Point:Vector3d Pose:Pose PoseArray:Pose_V PoseStamped:Pose PoseWithCovariance:PoseWithCovariance "
    "PoseWithCovarianceStamped:PoseWithCovariance Quaternion:Quaternion Transform:Pose TransformStamped:Pose "
    "Twist:Twist TwistStamped:Twist TwistWithCovariance:TwistWithCovariance "
    "TwistWithCovarianceStamped:TwistWithCovariance Wrench:Wrench WrenchStamped:Wrench Vector3:Vector3d",
    "nav_msgs": "Odometry:Odometry,OdometryWithCovariance",
    "rosgraph_msgs": "Clock:Clock",
    "sensor_msgs": "BatteryState:BatteryState CameraInfo:CameraInfo FluidPressure:FluidPressure Image:Image Imu:IMU "
    "JointState:Model Joy:Joy LaserScan:LaserScan MagneticField:Magnetometer NavSatFix:NavSat "
    "PointCloud2:PointCloudPacked",
    "std_msgs": "Bool:Boolean ColorRGBA:Color Empty:Empty Float32:Float Float64:Double Header:Header Int32:Int32 "
    "UInt32:UInt32 String:StringMsg",
    "tf2_msgs": "TFMessage:Pose_V",
    "trajectory_msgs": "JointTrajectory:JointTrajectory",
}
"""By package: messages, each with the messages of Gazebo that it is converted into."""
_ROS = re.compile(r"([a-z][a-z0-9_]*)/(?:msg/)?([A-Za-z]\w*)")
_GAZEBO = re.compile(r"(?:gz|ignition)\.msgs\.(\w+)")


@cache
def _pairs() -> dict[str, dict[str, tuple[str, ...]]]:
    return {
        package: {name: tuple(others.split(",")) for name, _, others in (one.partition(":") for one in text.split())}
        for package, text in _PAIRS.items()
    }


def refused_pair(ros: str, gazebo: str) -> str:
    """Return why the bridge does not convert a pair of types, with what was expected; empty where it may.

    Packages whose messages are not known here are let be: a later version may convert them.
    """
    match = _ROS.fullmatch(ros)
    if match is None:
        return f"{ros!r} is no type of a message of ROS; expected one such as 'std_msgs/msg/Float64'"
    package, name = match[1], match[2]
    known = _pairs().get(package)
    if known is None:
        return ""
    if name not in known:
        return _unknown(package, name, known) if not _exists(package, name) else ""
    other = _GAZEBO.fullmatch(gazebo)
    if other is None:
        return f"{gazebo!r} is no type of a message of Gazebo; expected 'gz.msgs.{known[name][0]}'"
    if other[1] not in known[name]:
        prefix = gazebo.rpartition(".")[0]
        expected = " or ".join(repr(f"{prefix}.{one}") for one in known[name])
        return f"{ros!r} is not converted into {gazebo!r}; expected {expected}"
    return ""


def _unknown(package: str, name: str, known: dict[str, tuple[str, ...]]) -> str:
    near = next((one for one in known if one.lower() == name.lower()), "")
    near = near or next(iter(get_close_matches(name, known, 1)), "")
    advice = f"; expected {f'{package}/msg/{near}'!r}" if near else "; expected the name of a message"
    return f"{package} has no message {name!r}{advice}"


def unknown_message(ros: str) -> str:
    """Return what is wrong with the type of a message of ROS; empty where it exists or is not known here."""
    match = _ROS.fullmatch(ros)
    if match is None or match[1] not in _pairs() or _exists(match[1], match[2]):
        return ""
    return _unknown(match[1], match[2], _pairs()[match[1]])


@cache
def _exists(package: str, name: str) -> bool:
    """Return whether a package of ROS has a message of that name in any distribution."""
    is_published = published_interface(2, f"{package}/msg/{name}") is not None
    return is_published or name in STANDARD.get((package, "msg"), ())
