"""Rule ``node.endless_loop``: a loop that no shutdown ends."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import body_of
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FIRMWARE, ROS_CPP, FileRule

_FOREVER = re.compile(r"while ?\((?:true|1)|for ?\( ?; ?; ?")
_LONGEST_HEAD = 30
_ENDS = re.compile(
    rb"\b(break|return|goto|throw|exit|abort|co_await|co_return)\b|\b(ok|isShuttingDown|isStopRequested|is_canceling|"
    rb"isPreemptRequested|joinable|interruption_point)\s*\("
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop without a condition whose body neither leaves it nor asks whether the node is to end."""
    loop, body = node, body_of(node)
    if body is None or not _FOREVER.fullmatch(view.text(loop)[:_LONGEST_HEAD].partition(")")[0]):
        return
    if view.mentions(FIRMWARE):
        return
    if _ENDS.search(view.code[body.start_byte : body.end_byte]):
        return
    # A thread that is let go ends with the process, and so does what a handler of the signal ends.
    if b"signal(SIGINT" in view.code or (b"detach" in view.code and b"main" not in _function(node, view)):
        return
    head = " ".join(view.code[loop.start_byte : body.start_byte].decode("utf-8", "replace").split())
    expected = "rclcpp::ok()" if view.mentions((b"rclcpp",)) else "ros::ok()"
    yield view.hit(
        "node.endless_loop",
        node,
        f"`{head}` never ends: nothing in it leaves it or asks `{expected}`; expected `while ({expected})`",
    )


def _function(node: Node, view: FileView) -> bytes:
    """Return the name of the function around a loop."""
    around = above(node, "function_definition", "lambda_expression")
    declarator = around.child_by_field_name("declarator") if around is not None else None
    return view.code[declarator.start_byte : declarator.end_byte] if declarator is not None else b""


RULE = FileRule(
    id="node.endless_loop",
    title="Loop that no shutdown ends",
    finds="`while (true)` or `for (;;)` in a node, without a way out and without a look at `ok()`. Ask `ok()`.",
    why="ROS takes Ctrl-C and the launch's signal away from the process and only sets `ok()` to false: a loop that "
    "does not "
    "ask keeps the process, and the hardware it drives, running until it is killed.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="#include <ros/ros.h>\nvoid f() { while (true) { work(); } }\n",
    good="#include <ros/ros.h>\nvoid f() { while (ros::ok()) { work(); } }\n",
    syntax="cpp",
    kinds=("while_statement", "for_statement"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
