"""Rule ``node.rotation_missing``: a pose of ROS 1 whose rotation is none."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, body_of, call_at, function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROSCPP, FileRule

_KINDS = rb"(?:PoseStamped|TransformStamped|PoseWithCovarianceStamped)"

_DECLARED = re.compile(rb"geometry_msgs::" + _KINDS + rb"\s+([\w\x80-\xff]+)")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a local pose or transform that is sent and whose rotation is never touched, though its place is."""
    call, function = call_at(node), function_around(node)
    body = body_of(function) if function is not None else None
    given = arguments(call) if call is not None else ()
    if call is None or body is None or len(given) != 1 or given[0].type != "identifier":
        return
    code = view.code[body.start_byte : call.start_byte]
    if (word := view.text(given[0]).encode()) not in _DECLARED.findall(code):
        return
    name = re.escape(word)
    if not re.search(rb"geometry_msgs::" + _KINDS + rb"\s+" + name + rb"\s*(?:\(\s*\))?\s*;", code):
        return
    uses = re.findall(rb"\b" + name + rb"\b((?:\s*\.\s*\w+)*)", code)[1:]
    touched = b" ".join(uses)
    if b"rotation" in touched or b"orientation" in touched or not re.search(rb"position|translation", touched):
        return
    if all(re.search(rb"header|child_frame_id|position|translation", use) for use in uses):
        yield view.hit(
            "node.rotation_missing",
            call,
            f"`{view.text(given[0])}` is sent with a rotation of (0, 0, 0, 0), which is none; expected `w = 1.0` at "
            "least",
        )


RULE = FileRule(
    id="node.rotation_missing",
    title="Pose or transform without a rotation (ROS 1)",
    finds="A pose or transform whose place a function sets, and its rotation not, before it sends it. Set `w` to 1.0.",
    why="In ROS 1 all parts of a quaternion begin as 0: tf drops the transform, move_base refuses the goal, rviz shows "
    "nothing.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros1",),
    tags=("messages", "transforms"),
    bad="#include <ros/ros.h>\nvoid f() { geometry_msgs::PoseStamped p; p.pose.position.x = 1; pub.publish(p); }\n",
    good="#include <ros/ros.h>\n"
    "void f() { geometry_msgs::PoseStamped p; p.pose.position.x = 1; p.pose.orientation.w = 1; pub.publish(p); }\n",
    syntax="cpp",
    anchors=("publish", "sendTransform"),
    mentions=ROSCPP,
    spares_tests=True,
    found=found,
)
