"""Rule ``node.stamp_zero``: a message that is published with time 0."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, body_of, call_at, function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_ZERO = rb"(?:ros|rclcpp)::Time\(\s*(?:0(?:\.0)?)?(?:\s*,\s*0)?\s*\)"

_ZEROED = re.compile(rb"stamp\s*=\s*" + _ZERO)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``publish(m)`` of a variable whose stamp the function sets to 0, and to nothing else."""
    call, function = call_at(node), function_around(node)
    body = body_of(function) if function is not None else None
    given = arguments(call) if call is not None else ()
    if call is None or body is None or len(given) != 1 or given[0].type not in ("identifier", "pointer_expression"):
        return
    code = view.code[body.start_byte : call.start_byte]
    if _ZEROED.search(code) is None:
        return
    name = re.escape(view.text(given[0]).lstrip("*&").encode())
    stamp = rb"(?<![\w.])" + name + rb"\s*(?:\.|->)\s*header\s*\.\s*stamp\s*=(?!=)\s*"
    if re.search(stamp + _ZERO + rb"\s*;", code) and len(re.findall(stamp, code)) == 1:
        yield view.hit(
            "node.stamp_zero",
            call,
            f"`{view.text(given[0])}` is published with the stamp 0; expected the time of its data, or now()",
        )


RULE = FileRule(
    id="node.stamp_zero",
    title="Message published with time 0",
    finds="A message whose stamp a function sets to `Time(0)` before it publishes it. Stamp it with the time of its "
    "data. In no "
    "profile: trajectories mean «at once» by it, markers the newest transform.",
    why="Time 0 means «the newest» to a look-up of a transform and 1970 to everybody else: filters drop it, and a "
    "recording "
    "cannot be put in order.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    tags=("messages", "time"),
    bad="#include <ros/ros.h>\nvoid f() { PoseStamped p; p.header.stamp = ros::Time(0); pub.publish(p); }\n",
    good="#include <ros/ros.h>\nvoid f() { PoseStamped p; p.header.stamp = ros::Time::now(); pub.publish(p); }\n",
    syntax="cpp",
    anchors=("publish",),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
