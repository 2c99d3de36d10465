"""Rule ``node.whole_seconds``: a difference of times whose fraction is left out."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import function_around, statement_around, whole_name
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_COMPARED = frozenset(("<", ">", "<=", ">="))
"""With a limit of many seconds the fraction does not matter."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``a.sec - b.sec`` in a statement that does not look at the nanoseconds."""
    name = whole_name(node)
    around = name.parent
    if around is None or around.type != "binary_expression" or around.child_by_field_name("left") != name:
        return
    right = view.text(around.child_by_field_name("right"))
    if view.text(around.child_by_field_name("operator")) != "-" or not re.search(
        r"stamp\.sec$|time\.sec$|now\(\)\.sec$", right
    ):
        return
    if around.parent is not None and view.text(around.parent.child_by_field_name("operator")) in _COMPARED:
        return
    if around.parent is not None and view.text(around.parent.child_by_field_name("operator")) == "+=":
        # What is left out of one difference is in the next.
        return
    function = function_around(name) or statement_around(name)
    if b"nsec" not in (code := view.code[function.start_byte : function.end_byte]) and b"nanosec" not in code:
        yield view.hit(
            "node.whole_seconds",
            around,
            f"`{view.text(around)}` leaves out the nanoseconds: 0.999 s and 0 s are the same; expected the difference "
            "of "
            "the times, in seconds",
        )


RULE = FileRule(
    id="node.whole_seconds",
    title="Difference of whole seconds",
    finds="`a.sec - b.sec` without a look at the nanoseconds. Subtract the times: `(a - b).toSec()`, `.seconds()`. "
    "Differences that are summed, each from where the last ended, are left out.",
    why="Times that are a millisecond apart may differ by one second, and times that are almost one apart by none: a "
    "timeout or "
    "a velocity made of it jumps.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="#include <ros/ros.h>\nint dt = now.stamp.sec - last.stamp.sec;\n",
    good="#include <ros/ros.h>\ndouble dt = (now.stamp - last.stamp).toSec();\n",
    syntax="cpp",
    anchors=("sec",),
    mentions=ROS_CPP,
    found=found,
)
