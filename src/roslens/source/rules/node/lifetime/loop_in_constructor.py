"""Rule ``node.loop_in_constructor``: a component or nodelet whose making never ends."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import function_around, loop_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_ENDS = re.compile(rb"\b(break|return|wait_for_service|waitForExistence|waitForServer|wait_for)\b")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop until shutdown in a constructor or in ``onInit``."""
    loop, function = loop_around(node), function_around(node)
    if loop is None or function is None or function.type != "function_definition":
        return
    condition = loop.child_by_field_name("condition")
    if condition is None or view.text(condition).strip("()").removesuffix("(") not in ("ros::ok", "rclcpp::ok"):
        return
    scope, _, last = function_name(function, view).rpartition("::")
    if not scope or (scope != last and last != "onInit") or _ENDS.search(view.code[loop.start_byte : loop.end_byte]):
        return
    yield view.hit(
        "node.loop_in_constructor",
        condition,
        f"`while {view.text(condition)}` in `{scope}::{last}`, which does not return before shutdown; expected a "
        "timer, or a "
        "thread",
    )


RULE = FileRule(
    id="node.loop_in_constructor",
    title="Constructor or onInit that loops until shutdown",
    finds="`while (ros::ok())` or `while (rclcpp::ok())` without a way out in a constructor or in `onInit`. Use a "
    "timer.",
    why="A container or nodelet manager waits for it: no other component is loaded, and none of this one's callbacks "
    "ever runs.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="#include <ros/ros.h>\nArm::Arm() { while (ros::ok()) { step(); rate_.sleep(); } }\n",
    good="#include <ros/ros.h>\nArm::Arm() { timer_ = nh_.createTimer(ros::Duration(0.1), &Arm::step, this); }\n",
    syntax="cpp",
    anchors=("ros::ok", "rclcpp::ok"),
    mentions=ROS_CPP,
    found=found,
)
