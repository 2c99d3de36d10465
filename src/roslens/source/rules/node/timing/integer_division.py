"""Rule ``node.integer_division``: a duration whose fraction is cut off."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import constructed, whole_name, whole_quotient
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_MOST_LOST = 0.05
"""Of the quotient; less is rounding."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a duration made of a quotient of whole numbers that is none."""
    name = view.text(whole_name(node))
    for one in constructed(node) or ():
        quotient = whole_quotient(one, view)
        if quotient is not None and quotient[1] and _is_much(one, quotient[0], view):
            yield view.hit(
                "node.integer_division",
                one,
                f"`{view.text(one)}` is {quotient[0]} in whole numbers, so `{name}` is shorter than meant; expected a "
                "decimal point",
            )


def _is_much(one: Node, whole: int, view: FileView) -> bool:
    """Return whether so much is cut off that a period is another one: 16 ms of 16.67 are what everybody writes."""
    left, right = (int(view.text(one.child_by_field_name(side))) for side in ("left", "right"))
    return (left / right - whole) * right > _MOST_LOST * left


RULE = FileRule(
    id="node.integer_division",
    title="Duration cut off by integer division",
    finds="A duration made of a quotient of whole numbers that loses more than a twentieth: `ros::Duration(1 / 10)` "
    "is 0. `1000 / 60`, which is 16 and not 16.67, is let be. Write a decimal point.",
    why="The timer runs as fast as the processor can, or the timeout is over at once.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="#include <ros/ros.h>\nros::Duration period(1 / 10);\n",
    good="#include <ros/ros.h>\nros::Duration period(1.0 / 10);\n",
    syntax="cpp",
    anchors=("Duration", "WallDuration", "from_seconds", "milliseconds", "microseconds"),
    mentions=ROS_CPP,
    found=found,
)
