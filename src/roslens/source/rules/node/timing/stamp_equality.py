"""Rule ``node.stamp_equality``: two times compared as floating-point numbers."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import call_at, number_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``==`` and ``!=`` of seconds with something that is no literal."""
    call = call_at(node)
    around = call.parent if call is not None else None
    if call is None or around is None or around.type != "binary_expression":
        return
    left, right = around.child_by_field_name("left"), around.child_by_field_name("right")
    other = right if left == call else left
    if view.text(around.child_by_field_name("operator")) in ("==", "!=") and number_of(other, view) is None:
        yield view.hit(
            "node.stamp_equality",
            around,
            f"`{view.text(around)}` compares seconds as floating-point numbers; expected the times themselves",
        )


RULE = FileRule(
    id="node.stamp_equality",
    title="Times compared as floating-point numbers",
    finds="`a.toSec() == b.toSec()` or `a.seconds() != b.seconds()`. Compare the times.",
    why="Seconds since 1970 as a `double` have steps of 0.2 µs: stamps of a fast sensor that differ become equal, and "
    "what was "
    "computed twice differs.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="#include <ros/ros.h>\nbool f() { return a.stamp.toSec() == b.stamp.toSec(); }\n",
    good="#include <ros/ros.h>\nbool f() { return a.stamp == b.stamp; }\n",
    syntax="cpp",
    anchors=("toSec", "seconds"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
