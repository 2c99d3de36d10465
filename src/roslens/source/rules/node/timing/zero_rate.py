"""Rule ``node.zero_rate``: a rate of 0 Hz."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import constructed, number_of, whole_name, whole_quotient
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_RATES = frozenset(("ros::Rate", "ros::WallRate", "rclcpp::Rate", "rclcpp::WallRate"))
_OF_ROS = re.compile(rb"\busing\s+(?:namespace\s+)?(?:ros|rclcpp)(?:::(?:Wall)?Rate)?\s*;")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a rate whose argument is 0, or a quotient of whole numbers that is."""
    name = view.text(whole_name(node))
    given = constructed(node)
    if not given or not (name in _RATES or (name in ("Rate", "WallRate") and _OF_ROS.search(view.code))):
        return
    if number_of(given[0], view) == 0 or whole_quotient(given[0], view) == (0, True):
        yield view.hit(
            "node.zero_rate",
            given[0],
            f"`{name}` of `{view.text(given[0])}`, which is 0 Hz: the period is 1/0; expected more than 0",
        )


RULE = FileRule(
    id="node.zero_rate",
    title="Rate of zero",
    finds="`ros::Rate` or `rclcpp::Rate` of 0, also where a division of whole numbers gives 0 (`1 / 10`). Write `0.1`.",
    why="The period is one divided by the rate: roscpp sleeps for ever or not at all, rclcpp throws, and the loop that "
    "drives the robot does not run.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="#include <ros/ros.h>\nvoid f() { ros::Rate rate(1 / 10); rate.sleep(); }\n",
    good="#include <ros/ros.h>\nvoid f() { ros::Rate rate(0.1); rate.sleep(); }\n",
    syntax="cpp",
    anchors=("Rate", "WallRate"),
    mentions=ROS_CPP,
    found=found,
)
