"""Rule ``node.deprecated_ros2_python``: names of rclpy that are deprecated or gone."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.deprecated.table import PYTHON_ROS2, find
from roslens.source.rules.rule import RCLPY, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a name of the table."""
    # A stub, or a type of one's own, declares a member of that name.
    if node.parent is not None and node.parent.type == "assignment" and node.parent.child_by_field_name("left") == node:
        return iter(())
    return find(node, view, "node.deprecated_ros2_python", _ROWS)


_ROWS = PYTHON_ROS2

RULE = FileRule(
    id="node.deprecated_ros2_python",
    title="Deprecated name of ROS 2 (Python)",
    finds="A name that a distribution deprecated or removed. The finding says since when, and what to write.",
    why="What is deprecated warns in every build of everybody who uses it, and with the next distribution it does not "
    "build.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("deprecated",),
    bad="import rclpy\nself.set_parameters_callback(self.check)\n",
    good="import rclpy\nself.add_on_set_parameters_callback(self.check)\n",
    syntax="python",
    anchors=tuple(row.name for row in PYTHON_ROS2),
    mentions=RCLPY,
    found=found,
)
