"""Classes outside of a workspace that make a class a node, and which generation of ROS a file belongs to."""

from __future__ import annotations

import re

from roslens.source.extract.ir.program import Program
from roslens.source.extract.symbols.symbol_table import SymbolTable

NODE_BASES = {
    "rclcpp.Node": ("ros2", "node"),
    "rclcpp_lifecycle.LifecycleNode": ("ros2", "lifecycle"),
    "rclpy.node.Node": ("ros2", "node"),
    "rclpy.Node": ("ros2", "node"),
    "rclpy.lifecycle.Node": ("ros2", "lifecycle"),
    "rclpy.lifecycle.LifecycleNode": ("ros2", "lifecycle"),
    "nodelet.Nodelet": ("ros1", "nodelet"),
}
"""Generation and kind by whole name."""
_ROS2 = re.compile(r"(rclcpp|rclpy|ament_|tf2_ros/.*\.hpp$|.*/(msg|srv|action)/.*\.hpp$|pluginlib/.*\.hpp$)")
_ROS1 = re.compile(r"(ros/.*\.h$|roscpp|rospy|nodelet/|tf/|[a-z]\w*/[A-Z]\w*\.h$)")


def generation_of(index: SymbolTable, path: str) -> str:
    """Return the generation of ROS that a file belongs to, by its headers or modules, else by most of its package.

    An index that is of one version says so for all its files.
    """
    if index.version:
        return index.version
    own = _included(index.programs[path])
    if own:
        return "ros2" if own > 0 else "ros1"
    return "ros2" if index.contents.votes(path, _included) > 0 else "ros1"


def _included(program: Program) -> int:
    """Return whether a file includes what is of ROS 2 (1), of ROS 1 (-1), or neither or both."""
    names = [name.strip('<>"') for name, _ in program.includes]
    return any(_ROS2.match(name) for name in names) - any(_ROS1.match(name) for name in names)
