"""Rule ``node.duration_and_number``: a duration compared with a number, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import call_at, number_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a comparison of the difference to the present time with a literal number."""
    call = call_at(node)
    text = view.text(call)
    if call is None or not text.endswith(("Time.now()", "get_rostime()", "get_clock().now()")):
        return
    difference = call.parent
    if difference is None or difference.type != "binary_operator":
        return
    if view.text(difference.child_by_field_name("operator")) != "-":
        return
    around = difference.parent
    while around is not None and around.type == "parenthesized_expression":
        around = around.parent
    if around is None or around.type != "comparison_operator":
        return
    if any(number_of(one, view) is not None for one in around.named_children):
        expected = ".to_sec()" if "rospy" in text else ".nanoseconds / 1e9"
        yield view.hit(
            "node.duration_and_number",
            around,
            f"`{view.text(around)}` compares a duration with a number, which raises TypeError; expected "
            f"`({view.text(difference)}){expected}`",
        )


RULE = FileRule(
    id="node.duration_and_number",
    title="Duration compared with a number (Python)",
    finds="`rospy.Time.now() - start > 5`: a duration compared with a number. Compare its seconds.",
    why="Durations compare with durations only: Python 3 raises TypeError, Python 2 gave an answer that had nothing "
    "to do with "
    "time.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="import rospy\nif rospy.Time.now() - start > 5.0:\n    stop()\n",
    good="import rospy\nif (rospy.Time.now() - start).to_sec() > 5.0:\n    stop()\n",
    syntax="python",
    anchors=("now", "get_rostime"),
    mentions=ROS_PYTHON,
    found=found,
)
