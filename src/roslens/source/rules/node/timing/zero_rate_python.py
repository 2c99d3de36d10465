"""Rule ``node.zero_rate_python``: a rate of 0 Hz, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, number_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_IMPORTED = re.compile(rb"from\s+rospy(?:\.\w+)?\s+import\s+(?:\*|[^\n]*\bRate\b)")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a rate whose argument is 0."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if (
        call is not None
        and given
        and number_of(given[0], view) == 0
        and _is_of_ros(view.text(call.child_by_field_name("function")), view)
    ):
        yield view.hit(
            "node.zero_rate_python", given[0], f"`{view.text(call)}`: the period is 1/0; expected more than 0"
        )


def _is_of_ros(called: str, view: FileView) -> bool:
    """Return whether a function of a name makes a rate of rospy or rclpy, and none of the project's own."""
    return called.startswith("rospy.") or called.endswith("create_rate") or _IMPORTED.search(view.code) is not None


RULE = FileRule(
    id="node.zero_rate_python",
    title="Rate of zero (Python)",
    finds="`rospy.Rate(0)` or `create_rate(0)`. Name a frequency above 0 Hz.",
    why="The period is one divided by the rate: it raises ZeroDivisionError when the loop that drives the robot "
    "begins.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="import rospy\nrate = rospy.Rate(0)\n",
    good="import rospy\nrate = rospy.Rate(10)\n",
    syntax="python",
    anchors=("Rate", "create_rate"),
    mentions=ROS_PYTHON,
    found=found,
)
