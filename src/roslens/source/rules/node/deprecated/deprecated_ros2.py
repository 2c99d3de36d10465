"""Rule ``node.deprecated_ros2``: names of ROS 2 that are deprecated or gone."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.deprecated.table import CPP_ROS2, find
from roslens.source.rules.rule import RCLCPP, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a name of the table."""
    return find(node, view, "node.deprecated_ros2", _ROWS)


_ROWS = CPP_ROS2

RULE = FileRule(
    id="node.deprecated_ros2",
    title="Deprecated name of ROS 2",
    finds="A name that a distribution deprecated or removed. The finding says since when, and what to write. "
    "What is only deprecated is a note: the new name may not exist in an older distribution that is built for. For "
    "which distributions a package is built, `distro` in roslens.toml says.",
    why="What is deprecated warns in every build of everybody who uses it, and with the next distribution it does not "
    "build.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("deprecated",),
    fix="Writes the new name where it takes the old one's place as it is: executors, groups. Not "
    "where the call is another one.",
    bad="#include <rclcpp/rclcpp.hpp>\nauto done = rclcpp::executor::FutureReturnCode::SUCCESS;\n",
    good="#include <rclcpp/rclcpp.hpp>\nauto done = rclcpp::FutureReturnCode::SUCCESS;\n",
    syntax="cpp",
    anchors=tuple(row.name for row in CPP_ROS2),
    mentions=RCLCPP,
    found=found,
)
