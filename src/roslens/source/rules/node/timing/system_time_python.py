"""Rule ``node.system_time_python``: the computer's clock where the time of ROS is meant, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.timing.stamp_flow import reached
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_CLOCKS = frozenset(("time.time()", "time.time_ns()", "datetime.now()", "datetime.datetime.now()"))


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a look at the computer's clock that becomes a stamp or meets a time of ROS."""
    call = call_at(node)
    if call is None or view.text(call) not in _CLOCKS:
        return
    end = reached(call, view)
    if end is not None:
        yield view.hit(
            "node.system_time_python",
            call,
            f"`{view.text(call)}` does not follow simulated time, and jumps when the computer's clock is set"
            f"{end.carried}; expected `get_clock().now()` of the node, or `rospy.Time.now()`",
        )


RULE = FileRule(
    id="node.system_time_python",
    title="System clock in a stamp (Python)",
    finds="`time.time()`, `time.time_ns()` or `datetime.now()` that becomes the stamp of a message, or is compared "
    "with or subtracted from a time of ROS. The time is followed through variables, attributes and functions of the "
    "file. Use the clock of the node.",
    why="In simulation and in a played bag time begins elsewhere: transforms of such stamps do not exist, and messages "
    "seem to be years old.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("time", "simulation"),
    bad="import time\nimport rclpy\nnow = time.time()\nmsg.header.stamp.sec = int(now)\n",
    good="import rclpy\nmsg.header.stamp = self.get_clock().now().to_msg()\n",
    syntax="python",
    anchors=("time.time", "time.time_ns", "datetime.now"),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
