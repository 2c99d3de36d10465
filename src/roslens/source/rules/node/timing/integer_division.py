"""Rule ``node.integer_division``: a duration whose fraction is cut off."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.calls import constructed, whole_name, whole_quotient
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a duration made of a quotient of whole numbers that is none."""
    name = view.text(whole_name(node))
    for one in constructed(node) or ():
        quotient = whole_quotient(one, view)
        if quotient is not None and quotient[1]:
            yield view.hit(
                "node.integer_division",
                one,
                f"`{view.text(one)}` is {quotient[0]} in whole numbers, so `{name}` is shorter than meant; expected a "
                "decimal point",
            )


RULE = FileRule(
    id="node.integer_division",
    title="Duration cut off by integer division",
    finds="A duration made of a quotient of whole numbers that does not come out even: `ros::Duration(1 / 10)` is 0. "
    "Write "
    "a decimal point.",
    why="The timer runs as fast as the processor can, or the timeout is over at once.",
    severity=Severity.ERROR,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="#include <ros/ros.h>\nros::Duration period(1 / 10);\n",
    good="#include <ros/ros.h>\nros::Duration period(1.0 / 10);\n",
    syntax="cpp",
    anchors=("Duration", "WallDuration", "from_seconds", "milliseconds", "microseconds"),
    mentions=ROS_CPP,
    found=found,
)
