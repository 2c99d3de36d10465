"""Rule ``node.stamp_in_float``: a time of day in 32 bits."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import call_at, receiver, statement_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_TIMES = re.compile(r"(\bnow\(\)|\bstamp|\bTime\(.*\))\)?$")

_DIFFERENCE = re.compile(r"-(?!>)")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a time that is made seconds and kept in a ``float``."""
    call = call_at(node)
    of = receiver(call) if call is not None else None
    if (
        call is None
        or call.parent is None
        or of is None
        or not _TIMES.search(view.text(of))
        or _DIFFERENCE.search(view.text(of))
    ):
        return
    statement = statement_around(call)
    declared = statement.type == "declaration" and view.text(statement.child_by_field_name("type")) == "float"
    cast = view.text(call.parent.parent if call.parent.type == "argument_list" else call.parent)
    if (declared and call.parent.type == "init_declarator") or cast.startswith(
        ("static_cast<float>", "float(", "(float)")
    ):
        yield view.hit(
            "node.stamp_in_float",
            call,
            f"`{view.text(call)}` in a `float`, whose steps are 128 s at today's date; expected `double`, or the "
            "difference of two times first",
        )


RULE = FileRule(
    id="node.stamp_in_float",
    title="Time of day in a float",
    finds="Seconds since 1970 kept in a `float`. Keep `Time`, subtract first, or use `double`.",
    why="24 bits cannot hold 1.7 billion seconds to less than 128: all times within two minutes are the same, and "
    "differences of them are 0 or 128.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="#include <ros/ros.h>\nvoid f() { float start = ros::Time::now().toSec(); }\n",
    good="#include <ros/ros.h>\nvoid f() { double start = ros::Time::now().toSec(); }\n",
    syntax="cpp",
    anchors=("toSec", "seconds"),
    mentions=ROS_CPP,
    found=found,
)
