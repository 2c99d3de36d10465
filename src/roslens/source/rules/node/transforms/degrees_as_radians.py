"""Rule ``node.degrees_as_radians``: an angle that is no angle in radians."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import tau

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, number_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_OWN = re.compile(rb"\b(?:void|Quaternion|auto)\s+(?:\w+::)*(\w+)\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a literal angle beyond a full turn."""
    call = call_at(node)
    if view.text(node).encode() in view.names(_OWN):
        # A function of the file's own may take degrees.
        return
    for one in arguments(call) if call is not None else ():
        value = number_of(one, view)
        if value is not None and abs(value) > tau + 0.01:
            yield view.hit(
                "node.degrees_as_radians",
                one,
                f"angle `{view.text(one)}` in `{view.text(node)}`, which takes radians: more than a full turn; "
                "expected "
                f"`{view.text(one)} * M_PI / 180.0`",
            )


RULE = FileRule(
    id="node.degrees_as_radians",
    title="Degrees where radians are expected",
    finds="A literal angle beyond 6.29 in a function that takes radians: `setRPY(0, 0, 90)`. Convert it.",
    why="90 rad is 116 degrees: the frame is turned, and the robot drives or grasps somewhere else.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms",),
    bad="#include <ros/ros.h>\nvoid f() { q.setRPY(0, 0, 90); }\n",
    good="#include <ros/ros.h>\nvoid f() { q.setRPY(0, 0, M_PI / 2); }\n",
    syntax="cpp",
    anchors=(
        *("setRPY", "setEuler", "setEulerZYX", "createQuaternionFromYaw", "createQuaternionMsgFromYaw"),
        *("createQuaternionFromRPY", "createQuaternionMsgFromRollPitchYaw"),
    ),
    mentions=ROS_CPP,
    found=found,
)
