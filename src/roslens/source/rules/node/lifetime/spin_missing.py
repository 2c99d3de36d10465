"""Rule ``node.spin_missing``: a program that subscribes and never spins."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import body_of, call_at, function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_NEEDS_SPIN = re.compile(
    rb"\b(subscribe|create_subscription|advertiseService|create_service|createTimer|create_wall_timer)\b\s*[<(]"
)
_NODE = re.compile(rb"\bNodeHandle\s*&?\s+(\w+)|(?<![\w.])(\w+)\s*=[^;=]*\bmake_shared\b")
_MAKES = re.compile(rb"\b(\w+)(?:\s+\w+)?\s*[({](?:[^;(){}]*,)?$")
"""A class whose object is made, or a function that is called, up to an argument."""
_OWN_CLASS = re.compile(rb"\b(?:class|struct)\s+(\w+)\s*\{")
"""A class without a base."""
_SPINS = re.compile(
    rb"[sS]pin|waitForShutdown|\bexec\s*\(|callAvailable|callOne|\bwait\b|WaitSet|exec_|[rR]un\s*\(|thread"
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the beginning of a ``main`` that subscribes, in a file that spins nowhere."""
    call, function = call_at(node), function_around(node)
    body = body_of(function) if function is not None else None
    if call is None or function is None or body is None or function.type != "function_definition":
        return
    if function_name(function, view) != "main" or _SPINS.search(view.code):
        return
    given = _given_to(view, body)
    if not given <= view.names(_OWN_CLASS):
        return
    # What a class of this file is given may be registered in its methods.
    start, end = (0, len(view.code)) if given else (body.start_byte, body.end_byte)
    registers = _NEEDS_SPIN.search(view.code, start, end)
    if registers is None:
        return
    yield view.hit(
        "node.spin_missing",
        call,
        f"`main` calls `{registers[1].decode()}` and nothing in this file spins: the callback never runs; expected "
        + ("`ros::spin()`" if view.text(call).removeprefix("::").startswith("ros::") else "`rclcpp::spin(node)`"),
    )


def _given_to(view: FileView, body: Node) -> frozenset[bytes]:
    """Return the classes and functions that the node or its handle is handed to, and that may spin."""
    code = view.code[body.start_byte : body.end_byte]
    names = {one[1] or one[2] for one in _NODE.finditer(code)}
    found: set[bytes] = set()
    for name in names:
        for match in re.finditer(rb"[(,{]\s*(?:std::move\()?&?%s\s*[,)}]" % re.escape(name), code):
            made = _MAKES.search(code, 0, match.start() + 1)
            found.add(made[1] if made is not None else b"")
    return frozenset(found)


RULE = FileRule(
    id="node.spin_missing",
    title="Program that never spins",
    finds="A `main` that makes a subscription, service or timer, itself or by a class of the file that it gives its "
    "node to, in a file without a call that spins. Spin.",
    why="Callbacks run when the program spins and at no other time: the node is there, is connected, and does nothing.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="""#include <ros/ros.h>
int main(int c, char** v) { ros::init(c, v, "n"); ros::NodeHandle n; auto s = n.subscribe("x", 1, f); sleep(9); }
""",
    good="""#include <ros/ros.h>
int main(int c, char** v) { ros::init(c, v, "n"); ros::NodeHandle n; auto s = n.subscribe("x", 1, f); ros::spin(); }
""",
    syntax="cpp",
    anchors=("ros::init", "rclcpp::init"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
