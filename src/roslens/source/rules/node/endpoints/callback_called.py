"""Rule ``node.callback_called``: the result of a callback is handed over instead of the callback."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, keywords
from roslens.source.rules.file_view import FileView, below
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
    """Tell whether this file defines a function once, and it gives nothing back."""
    places = [match.start(1) for match in re.finditer(rb"\bdef[ \t]+(" + name.encode() + rb")\b", view.code)]
    node = view.node_at(places[0], places[0] + len(name)) if len(places) == 1 and name.isidentifier() else None
    function = node.parent if node is not None else None
    if function is None or function.type != "function_definition":
        return False
    around = function.parent
    if around is not None and around.type == "decorated_definition":
        return False
    if next(below(function, "raise_statement"), None) is not None:
        # Classes that are derived from this one give back something.
        return False
    if any(one.named_child_count for one in below(function, "return_statement")):
        return False
    return next(below(function, "yield"), None) is None


RULE = FileRule(
    id="node.callback_called",
    title="Callback called where it should be handed over",
    finds="`create_timer(1.0, self.tick())` and the like: the callback is called, and None is registered. Leave the "
    "parentheses out.",
    why="The callback runs once, before the node spins, and never again; in ROS 2 the executor fails at the first "
    "message.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
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
    spares_tests=True,
    found=found,
)
