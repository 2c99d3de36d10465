"""Rule ``node.zero_rate_python``: a rate of 0 Hz, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.calls import arguments, call_at, number_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a rate whose argument is 0."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if given and number_of(given[0], view) == 0:
        yield view.hit(
            "node.zero_rate_python", given[0], f"`{view.text(call)}`: the period is 1/0; expected more than 0"
        )


RULE = FileRule(
    id="node.zero_rate_python",
    title="Rate of zero (Python)",
    finds="`rospy.Rate(0)` or `create_rate(0)`. Name a frequency above 0 Hz.",
    why="The period is one divided by the rate: it raises ZeroDivisionError when the loop that drives the robot "
    "begins.",
    severity=Severity.ERROR,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="import rospy\nrate = rospy.Rate(0)\n",
    good="import rospy\nrate = rospy.Rate(10)\n",
    syntax="python",
    anchors=("Rate", "create_rate"),
    mentions=ROS_PYTHON,
    found=found,
)
