"""Rule ``node.rate_in_loop_python``: a rate that is made anew in the loop that it should pace, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, loop_around, statement_around
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a rate that is made and slept on in the same round of a loop."""
    call = call_at(node)
    loop = loop_around(call) if call is not None else None
    if call is None or loop is None or call.parent is None:
        return
    statement = statement_around(call)
    block = statement.parent
    if block is None or block.parent != loop:
        return
    if loop.type == "for_statement" and _depends(call, loop, view):
        return
    at_once = re.search(rb"\)\.sleep\s*\(", view.code[call.end_byte - 1 : statement.end_byte]) is not None
    variable = view.text(call.parent.child_by_field_name("left")) if call.parent.type == "assignment" else ""
    rest = view.code[statement.end_byte : block.end_byte]
    later = re.search(rb"(?<![\w.])" + re.escape(variable.encode()) + rb"\.sleep\b", rest) if variable else None
    if at_once or (later is not None and b"while " not in rest and b"for " not in rest):
        # To wait as long each round may be what is wanted; a timer of rclpy stays with its node.
        certainty = None if view.text(node) == "create_rate" else Certainty.HEURISTIC
        yield view.hit(
            "node.rate_in_loop_python",
            call,
            f"`{view.text(call)}` in the loop that it paces: each round sleeps for the whole period, whatever the "
            "round "
            "took; expected it before the loop",
            certainty=certainty,
        )


def _depends(call: Node, loop: Node, view: FileView) -> bool:
    """Return whether a rate is made of what the loop goes through: it is another one in each round."""
    left = loop.child_by_field_name("left")
    names = {view.text(left), *(view.text(one) for one in below(left, "identifier"))} if left is not None else set()
    return any(re.search(rf"\b{re.escape(name)}\b", view.text(one)) for name in names for one in arguments(call))


RULE = FileRule(
    id="node.rate_in_loop_python",
    title="Rate made inside of its loop (Python)",
    finds="`create_rate`, or as a note `rospy.Rate`, made and slept on in each round of a loop. Make it before.",
    why="A rate subtracts what the round took from its sleep only if it lives longer than the round: made anew, the "
    "loop "
    "is slower than its number says. In rclpy each call adds a timer that is never removed.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("time", "real-time"),
    bad="import rospy\nwhile not rospy.is_shutdown():\n    work()\n    rospy.Rate(10).sleep()\n",
    good="import rospy\nrate = rospy.Rate(10)\nwhile not rospy.is_shutdown():\n    work()\n    rate.sleep()\n",
    syntax="python",
    anchors=("Rate", "create_rate"),
    mentions=ROS_PYTHON,
    found=found,
)
