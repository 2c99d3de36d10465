"""Rule ``node.degrees_as_radians_python``: an angle that is no angle in radians, in Python."""

from __future__ import annotations

from collections.abc import Iterator
from math import tau

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, number_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a literal angle beyond a full turn."""
    call = call_at(node)
    if b"def " + view.text(node).encode() in view.code:
        # A function of the file's own may take degrees.
        return
    for one in arguments(call)[:3] if call is not None else ():
        value = number_of(one, view)
        if value is not None and abs(value) > tau + 0.01:
            yield view.hit(
                "node.degrees_as_radians_python",
                one,
                f"angle `{view.text(one)}` in `{view.text(node)}`, which takes radians: more than a full turn; "
                "expected "
                f"`math.radians({view.text(one)})`",
            )


RULE = FileRule(
    id="node.degrees_as_radians_python",
    title="Degrees where radians are expected (Python)",
    finds="A literal angle beyond 6.29 in a function that takes radians: `quaternion_from_euler(0, 0, 90)`. Convert "
    "it.",
    why="90 rad is 116 degrees: the frame is turned, and the robot drives or grasps somewhere else.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms",),
    bad="import rospy\nq = quaternion_from_euler(0, 0, 90)\n",
    good="import rospy\nq = quaternion_from_euler(0, 0, math.radians(90))\n",
    syntax="python",
    anchors=("quaternion_from_euler",),
    mentions=ROS_PYTHON,
    found=found,
)
