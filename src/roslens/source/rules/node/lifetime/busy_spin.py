"""Rule ``node.busy_spin``: a loop that spins as fast as the processor can."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import arguments, call_at, loop_around
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_QUICK = frozenset(
    (
        *("ok", "spinOnce", "spin_some", "publish", "now", "toSec", "isShuttingDown", "size", "empty", "get", "c_str"),
        *("push_back", "clear", "at", "begin", "end", "begin", "Time", "Duration", "sin", "cos", "sqrt", "abs", "fabs"),
        *("get_node_base_interface", "make_shared", "ROS_INFO", "ROS_DEBUG", "shared_from_this", "isNull", "valid"),
    )
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop that calls nothing that could wait."""
    call = call_at(node)
    loop = loop_around(call) if call is not None else None
    if call is None or loop is None or loop.type == "for_range_loop":
        return
    text = view.text(call.child_by_field_name("function"))
    given = arguments(call)
    if text != "ros::spinOnce" and (not text.endswith("spin_some") or (text != "rclcpp::spin_some" and given)):
        return
    code = view.code[loop.start_byte : loop.end_byte]
    if loop.type == "for_statement" and (re.search(rb"\b(break|return)\b", code) or _is_counted(loop, view)):
        return
    if all(callee_name(one, view) in _QUICK for one in below(loop, "call_expression")):
        yield view.hit(
            "node.busy_spin",
            call,
            f"`{text}` in a loop that waits for nothing: it takes a whole processor; expected `rate.sleep()` in it, or "
            + ("`ros::spin()`" if text.startswith("ros::") else "`rclcpp::spin(node)`"),
        )


def _is_counted(loop: Node, view: FileView) -> bool:
    """Return whether a loop of ``for`` goes round so many times and does not last as long as the node."""
    condition = view.text(loop.child_by_field_name("condition"))
    return bool(condition) and "ok" not in condition


RULE = FileRule(
    id="node.busy_spin",
    title="Spinning without a pause",
    finds="A loop around `spinOnce` or `spin_some` that calls nothing that could wait. Sleep by a rate, or `spin`.",
    why="The loop takes a whole processor to look for messages that are not there; on a robot's computer the "
    "controllers "
    "then get theirs too late.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("lifetime", "real-time"),
    bad="#include <ros/ros.h>\nint main() { while (ros::ok()) { ros::spinOnce(); } }\n",
    good="#include <ros/ros.h>\nint main() { ros::spin(); }\n",
    syntax="cpp",
    anchors=("spinOnce", "spin_some"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
