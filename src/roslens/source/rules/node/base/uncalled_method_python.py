"""Rule ``node.uncalled_method_python``: an attribute of a method of the node, where its result is meant."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import is_handled
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.base.derived_node import is_derived_node
from roslens.source.rules.rule import RCLPY, FileRule

_METHODS = frozenset({
    "get_logger", "get_clock", "get_name", "get_namespace", "get_parameter", "get_parameter_or", "create_rate",
    "get_fully_qualified_name", "declare_parameter",
})  # fmt: skip
"""Methods of a node whose result is what one asks something of."""


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each attribute that is asked of a method of a node instead of its result."""
    functions = python_functions(view)
    for attribute in view.nodes("attribute"):
        method = attribute.child_by_field_name("object")
        name = view.text(attribute.child_by_field_name("attribute"))
        if method is None or method.type != "attribute" or name.startswith("__"):
            continue
        called = view.text(method.child_by_field_name("attribute"))
        if called not in _METHODS or not functions.is_self(method.child_by_field_name("object")):
            continue
        of = functions.class_around(attribute)
        if of is None or not is_derived_node(of, view) or called in of.methods or called in of.attributes:
            continue
        if not is_handled(attribute):
            yield view.hit(
                "node.uncalled_method_python",
                attribute,
                f"`{view.text(attribute)}` asks the method `{called}` itself, which has no `{name}`: an "
                f"AttributeError; expected `self.{called}({'…' if 'parameter' in called else ''}).{name}`",
            )


RULE = FileRule(
    id="node.uncalled_method_python",
    title="Method of the node that is not called (rclpy)",
    finds="`self.get_clock.now()`, `self.get_logger.info(…)` and their kind in a class derived from `rclpy.node.Node` "
    "alone: brackets are missing behind the method.",
    why="A method has no such attribute: AttributeError when the line is reached, which may be long after the start.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("lifetime",),
    bad="""import rclpy
from rclpy.node import Node
class Arm(Node):
    def on_tick(self):
        self.last = self.get_clock.now()
""",
    good="""import rclpy
from rclpy.node import Node
class Arm(Node):
    def on_tick(self):
        self.last = self.get_clock().now()
""",
    syntax="python",
    whole=True,
    gathers=("attribute",),
    words=("get_logger", "get_clock", "get_name", "get_parameter", "declare_parameter"),
    mentions=RCLPY,
    found=found,
)
