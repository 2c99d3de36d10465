"""Rule ``node.rate_in_loop``: a rate that is made anew in the loop that it should pace."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import loop_around, statement_around, whole_name
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_RATES = frozenset(("ros::Rate", "ros::WallRate", "rclcpp::Rate", "rclcpp::WallRate"))


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a rate that is declared and slept on in the same round of a loop."""
    name = whole_name(node)
    loop = loop_around(name)
    if view.text(name) not in _RATES or loop is None:
        return
    statement = statement_around(name)
    declarator = statement.child_by_field_name("declarator")
    variable = view.text(declarator.child_by_field_name("declarator")) if declarator is not None else ""
    block = statement.parent
    if not variable.isidentifier() or block is None or block.parent != loop:
        return
    rest = view.code[statement.end_byte : block.end_byte]
    if (
        re.search(rb"\b" + variable.encode() + rb"\s*\.\s*sleep\b", rest)
        and b"while" not in rest
        and b"for" not in rest
    ):
        yield view.hit(
            "node.rate_in_loop",
            statement,
            f"`{view.text(statement)}` in the loop that it paces: each round sleeps for the whole period, whatever the "
            "round took; expected it before the loop",
        )


RULE = FileRule(
    id="node.rate_in_loop",
    title="Rate made inside of its loop",
    finds="A `Rate` that is made and slept on in each round of a loop. Make it before the loop.",
    why="A rate subtracts what the round took from its sleep only if it lives longer than the round: made anew, the "
    "loop "
    "is slower than its number says, by as much as it has to do.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("time", "real-time"),
    bad="#include <ros/ros.h>\nvoid f() { while (ros::ok()) { ros::Rate rate(10); work(); rate.sleep(); } }\n",
    good="#include <ros/ros.h>\nvoid f() { ros::Rate rate(10); while (ros::ok()) { work(); rate.sleep(); } }\n",
    syntax="cpp",
    anchors=("Rate", "WallRate"),
    mentions=ROS_CPP,
    found=found,
)
