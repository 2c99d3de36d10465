"""Rule ``node.mixed_clocks``: times of two clocks, compared or subtracted."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import constructed, number_of, whole_name
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_OPERATORS = frozenset(("-", "<", ">", "<=", ">=", "==", "!="))
_RAW = re.compile(r"stamp$")
_ROS_TIME = re.compile(
    r"^(?:this->)?(?:\w*node\w*(?:\(\))?(?:->|\.))?(?:get_clock\(\)->)?now\(\)$|^rclcpp::Time\(.*stamp\)$"
)
"""Of the clock of a node; any other object that is asked may be a clock of the system."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a time of the system's clock beside one of the node's."""
    given = constructed(node)
    made = whole_name(node).parent
    around = made.parent if made is not None else None
    if given is None or made is None or around is None or around.type != "binary_expression":
        return
    if any(number_of(one, view) is None for one in given):
        return
    operator = view.text(around.child_by_field_name("operator"))
    left, right = around.child_by_field_name("left"), around.child_by_field_name("right")
    other = view.text(right if left == made else left)
    if operator not in _OPERATORS or (other.startswith(view.text(node)) and not _ROS_TIME.search(other)):
        return
    if _RAW.search(other) and left != made:
        return
    certain = _ROS_TIME.search(other) is not None
    yield view.hit(
        "node.mixed_clocks",
        around,
        f"`{view.text(around)}`: `{view.text(made)}` is of the system's clock, and "
        + ("the other side" if certain else f"`{other}`, where it comes of a message or the node's clock,")
        + f" of ROS time, so `{operator}` throws; expected `rclcpp::Time(0, 0, RCL_ROS_TIME)` or `nanoseconds() == 0`",
        certainty=None if certain else Certainty.HEURISTIC,
    )


RULE = FileRule(
    id="node.mixed_clocks",
    title="Times of different clocks compared",
    finds="`rclcpp::Time()` or `rclcpp::Time(0)` compared with, or subtracted from, a time of the node's clock. Name "
    "the "
    "clock: `rclcpp::Time(0, 0, RCL_ROS_TIME)`.",
    why="A time without a clock type is of the system's clock, those of nodes and messages are of ROS time, and rclcpp "
    "throws «can't compare times with different time sources»: the process ends.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("time",),
    bad="#include <rclcpp/rclcpp.hpp>\nbool Arm::is_new() { return now() > rclcpp::Time(0); }\n",
    good="#include <rclcpp/rclcpp.hpp>\nbool Arm::is_new() { return now() > rclcpp::Time(0, 0, RCL_ROS_TIME); }\n",
    syntax="cpp",
    anchors=("rclcpp::Time",),
    mentions=RCLCPP,
    found=found,
)
