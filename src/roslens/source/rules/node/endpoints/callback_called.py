"""Rule ``node.callback_called``: the result of a callback is handed over instead of the callback."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.calls import arguments, call_at, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an argument that calls a function of this file that returns nothing."""
    call = call_at(node)
    if call is None:
        return
    named = keywords(call, view)
    for one in (*arguments(call)[1:], *(named[key] for key in ("callback", "handler", "execute_cb") if key in named)):
        name = view.text(one.child_by_field_name("function")) if one.type == "call" else ""
        if name and _returns_nothing(name.removeprefix("self."), view):
            yield view.hit(
                "node.callback_called",
                one,
                f"`{view.text(one)}` calls the callback once, now, and hands over None; expected `{name}`",
            )


def _returns_nothing(name: str, view: FileView) -> bool:
    if not name.isidentifier():
        return False
    head = rb"^([ \t]*)def " + name.encode() + rb"\b[^\n]*\n"
    match = re.search(head + rb"((?:\1[ \t]+[^\n]*\n|[ \t]*\n)*)", view.code, re.MULTILINE)
    return match is not None and re.search(rb"\breturn[ \t]+[^\s]|\byield\b", match[2]) is None


RULE = FileRule(
    id="node.callback_called",
    title="Callback called where it should be handed over",
    finds="`create_timer(1.0, self.tick())` and the like: the callback is called, and None is registered. Leave the "
    "parentheses out.",
    why="The callback runs once, before the node spins, and never again; in ROS 2 the executor fails at the first "
    "message.",
    severity=Severity.ERROR,
    profiles=("ros2", "ros1"),
    tags=("endpoints", "callbacks"),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        self.timer = self.create_timer(1.0, self.tick())
    def tick(self):
        self.n += 1
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        self.timer = self.create_timer(1.0, self.tick)
    def tick(self):
        self.n += 1
""",
    syntax="python",
    anchors=("create_timer", "create_subscription", "create_service", "Subscriber", "Timer", "Service"),
    mentions=ROS_PYTHON,
    found=found,
)
