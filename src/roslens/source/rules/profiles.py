"""Profiles: which native rules are on together. A rule declares those it belongs to."""

from __future__ import annotations

from roslens.model.source import Package

PROFILES = {
    "ros2": "Packages of ROS 2: what goes wrong on robots, in code, manifests, builds and launch files.",
    "ros1": "Packages of ROS 1: the same for roscpp, rospy and catkin.",
    "google": "The Google C++ style guide, as far as cpplint checks it.",
    "ros-style": "The C++ style guides of ROS 1 and ROS 2: names and layout.",
    "hicpp": "High Integrity C++ (PRQA 2013).",
    "misra-cpp-2008": "MISRA C++:2008.",
    "misra-cpp-2023": "MISRA C++:2023.",
    "autosar-cpp14": "AUTOSAR guidelines for C++14.",
    "jsf-av": "Joint Strike Fighter Air Vehicle C++ coding standards (2005).",
    "safety": "What the standards for safety-related C++ agree on.",
    "paper2016": "The rules that the study of 2016 counted, as far as they can be decided from one file.",
}
"""Name of each profile and what it is for."""

ROS2, ROS1 = "ros2", "ros1"
AUTOMATIC = "auto"
"""The default: ``ros2`` or ``ros1``, by package."""

_ROS_1_BUILD_TYPES = frozenset({"catkin"})
_ROS_1_LIBRARIES = frozenset({"roscpp", "rospy", "nodelet", "roslib", "dynamic_reconfigure"})
_ROS_2_LIBRARIES = frozenset({"rclcpp", "rclpy", "rclc", "rclcpp_components", "rclcpp_lifecycle"})


def profiles_of(package: Package) -> tuple[str, ...]:
    """Return the profiles that :data:`AUTOMATIC` stands for: of the ROS version for which a package is built.

    A package for both is held against both.
    """
    names = {dependency.name for dependency in package.dependencies}
    ros2 = bool(names & _ROS_2_LIBRARIES) or package.build_type.startswith("ament")
    ros1 = bool(names & _ROS_1_LIBRARIES) or package.build_type in _ROS_1_BUILD_TYPES
    return tuple(name for name, is_on in (("ros2", ros2 or not ros1), ("ros1", ros1)) if is_on)
