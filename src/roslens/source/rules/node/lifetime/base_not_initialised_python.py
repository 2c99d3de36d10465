"""Rule ``node.base_not_initialised_python``: a node of rclpy whose base is never initialised."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import is_handled
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_BASES = frozenset({"Node", "rclpy.node.Node", "LifecycleNode", "rclpy.lifecycle.LifecycleNode"})
_CALLED = re.compile(rb"\bsuper\s*\(|\b__init__\s*\(")
_OWN = re.compile(rb"\bself\s*\.\s*(?:create_\w+|declare_parameters?|get_parameter\w*|get_logger|get_clock|get_name)\b")


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each ``__init__`` of a node that calls that of its base nowhere."""
    for one in python_functions(view).classes.values():
        init = one.methods.get("__init__")
        if init is None or not one.bases or one.bases[0] not in _BASES or is_handled(one.node):
            continue
        start, body = one.node.start_byte, init.child_by_field_name("body")
        own = view.code[start : one.node.end_byte]
        if body is None or not _OWN.search(own) or len(_CALLED.findall(own)) > 1:
            continue
        yield view.hit(
            "node.base_not_initialised_python",
            init,
            f"`{one.name}.__init__` does not call that of `{one.bases[0]}`: an AttributeError as soon as the node is "
            "used; expected `super().__init__('name')` first",
        )


RULE = FileRule(
    id="node.base_not_initialised_python",
    title="Node whose base is not initialised (Python)",
    finds="A class derived from `Node` of rclpy whose `__init__` calls neither `super().__init__` nor that of the "
    "base, and that uses the node: makes endpoints, parameters or messages of the log. Call it first, with the name of "
    "the node.",
    why="The node has no handle: the first publisher, timer or parameter ends the program with an AttributeError.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("lifetime",),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        self.timer = self.create_timer(1.0, self.tick)
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        super().__init__("arm")
        self.timer = self.create_timer(1.0, self.tick)
""",
    syntax="python",
    whole=True,
    mentions=RCLPY,
    found=found,
)
