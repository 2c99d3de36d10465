"""Rule ``node.print_in_node``: a node in Python that prints."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around
from roslens.source.rules.calls import call_at, function_around
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_NODE = re.compile(r"\b(Node|LifecycleNode|DTROS)\b")

_TALKS = re.compile(rb"\b(input|raw_input|termios|stdin|getch|argparse|curses)\b")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first ``print`` of a function in a class that is a node, or in a callback."""
    statement = node.parent if node.parent is not None and node.parent.type == "print_statement" else call_at(node)
    if statement is None or (
        statement.type == "call" and view.text(statement.child_by_field_name("function")) != "print"
    ):
        return
    if view.has(_TALKS) or _again(statement, view):
        return
    of_class = above(statement, "class_definition")
    is_node = of_class is not None and _NODE.search(view.text(of_class.child_by_field_name("superclasses")))
    callback = "" if is_node else callback_around(statement, view)
    if callback is not None and (is_node or callback):
        logger = "self.get_logger().info" if view.mentions((b"rclpy",)) else "rospy.loginfo"
        yield view.hit(
            "node.print_in_node",
            statement,
            f"`{view.short(statement)}` in a node; expected `{logger}(...)`",
            callback=callback,
        )


def _again(statement: Node, view: FileView) -> bool:
    """Tell whether the function has printed before: once is enough to say it."""
    function = function_around(statement)
    before = view.code[function.start_byte : statement.start_byte] if function is not None else b""
    return re.search(rb"\bprint\b", before) is not None


RULE = FileRule(
    id="node.print_in_node",
    title="Print in a node",
    finds="`print` in a class that is a node, or in a callback, in a file that reads nothing from the terminal; once "
    "a function. Use the node's logger.",
    why="What is printed has no severity, no time and no node name and is in no log file and on no /rosout: after a "
    "failure "
    "in the field it is gone. Under a launch it is kept back until a buffer is full.",
    consequence=Consequence.STYLE,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("logging",),
    bad="import rospy\nrospy.Subscriber('goal', Goal, on)\ndef on(goal):\n    print('goal')\n",
    good="import rospy\nrospy.Subscriber('goal', Goal, on)\ndef on(goal):\n    rospy.loginfo('goal')\n",
    syntax="python",
    anchors=("print",),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
