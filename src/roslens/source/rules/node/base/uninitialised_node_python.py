"""Rule ``node.uninitialised_node_python``: a node that is used before its base is made."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import PythonFunctions, python_functions
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.base.derived_node import is_derived_node
from roslens.source.rules.rule import RCLPY, FileRule

_NEEDS = frozenset({
    "create_publisher", "create_subscription", "create_service", "create_client", "create_timer", "create_rate",
    "declare_parameter", "declare_parameters", "get_parameter", "get_logger", "get_clock", "get_name",
    "add_on_set_parameters_callback",
})  # fmt: skip
"""Methods of a node that raise AttributeError as long as it is not made."""
_MAKES = re.compile(r"super\(|Node\.__init__|\.__init__\(")


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first use of each node of the file that its constructor makes later."""
    functions = python_functions(view)
    for of in functions.classes.values():
        constructor = of.methods.get("__init__")
        if constructor is None or not is_derived_node(of, view):
            continue
        yield from _too_early(constructor, of.name, functions, view)


def _too_early(constructor: Node, name: str, functions: PythonFunctions, view: FileView) -> Iterator[Hit]:
    """Yield the first call in a constructor that needs the base, before the base is made."""
    text = view.text(constructor)
    makes = _MAKES.search(text)
    # A base that is never made is told by node.base_not_initialised_python.
    start = constructor.start_byte + len(text[: makes.start()].encode()) if makes is not None else -1
    for call in functions.calls_in(constructor):
        function = call.child_by_field_name("function")
        method = view.text(function.child_by_field_name("attribute")) if function is not None else ""
        if method in _NEEDS and functions.is_self(receiver(call)) and call.start_byte < start:
            yield view.hit(
                "node.uninitialised_node_python",
                call,
                f"`self.{method}` is called before `super().__init__`: `{name}` is no node yet, an AttributeError; "
                "expected `super().__init__('name')` as the first line of `__init__`",
            )
            return


RULE = FileRule(
    id="node.uninitialised_node_python",
    title="Node used before its base is made (rclpy)",
    finds="A class derived from `rclpy.node.Node` alone whose `__init__` calls `create_publisher`, "
    "`declare_parameter`, `get_logger` or another method of the node before `super().__init__(…)`.",
    why="The node does not exist yet: AttributeError, and the program ends at start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("lifetime",),
    bad="""import rclpy
from rclpy.node import Node
class Arm(Node):
    def __init__(self):
        self.tick = self.create_timer(1.0, self.on_tick)
        super().__init__('arm')
""",
    good="""import rclpy
from rclpy.node import Node
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.tick = self.create_timer(1.0, self.on_tick)
""",
    syntax="python",
    whole=True,
    words=("Node",),
    mentions=RCLPY,
    found=found,
)
