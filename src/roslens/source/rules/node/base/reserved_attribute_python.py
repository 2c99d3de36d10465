"""Rule ``node.reserved_attribute_python``: an attribute of a node that has the name of what rclpy keeps there."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import PythonClass, python_functions
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.base.derived_node import is_derived_node
from roslens.source.rules.rule import RCLPY, FileRule

_READ_ONLY = frozenset({
    "publishers", "subscriptions", "clients", "services", "timers", "guards", "waitables", "context",
    "default_callback_group", "handle",
})  # fmt: skip
"""Properties of ``rclpy.node.Node`` that cannot be set, in Humble to Rolling."""
_KEPT = {
    "_publishers": "its publishers",
    "_subscriptions": "its subscriptions",
    "_clients": "its clients",
    "_services": "its services",
    "_timers": "its timers",
    "_guards": "its guard conditions",
    "_parameters": "its parameters",
    "_descriptors": "the descriptors of its parameters",
    "_clock": "its clock",
    "_logger": "its logger",
    "_context": "its context",
    "_parameter_overrides": "the parameters that it is given",
    "_time_source": "the source of its time",
    "_rate_group": "the callback group of its rates",
}
"""Attributes in which ``rclpy.node.Node`` keeps what it needs, by name: what that is."""
_USED_LATER = {"_logger": ("get_logger",), "_clock": ("get_clock", "create_timer")}
"""Of those of which a node can do without: the methods that need them."""
_ALIKE = {"_clock": ("get_clock()", "Clock("), "_logger": ("get_logger(",)}
"""What such an attribute may be set to, as it is of the same kind."""


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first assignment to each attribute of a node that is none of its own."""
    for of in python_functions(view).classes.values():
        if not is_derived_node(of, view):
            continue
        for name, values in of.attributes.items():
            message = _message(name, values, of, view)
            at = _place(values)
            if message and at is not None:
                yield view.hit("node.reserved_attribute_python", at, message)


def _message(name: str, values: list[Node], of: PythonClass, view: FileView) -> str:
    """Return what is wrong with an attribute; empty where nothing is."""
    if name in of.methods:
        return ""
    if name in _READ_ONLY:
        return (
            f"`self.{name}` is a property of the node, which cannot be set: an AttributeError; expected another name, "
            f"such as `self.my_{name}`"
        )
    kept = _KEPT.get(name)
    if kept is None or _is_alike(name, values, view) or not _is_needed(name, of, view):
        return ""
    return (
        f"`self.{name}` is where rclpy keeps {kept} of the node, and this takes its place: what needs it fails, or "
        "goes on without; expected another name"
    )


def _is_alike(name: str, values: list[Node], view: FileView) -> bool:
    return any(word in view.text(value) for word in _ALIKE.get(name, ()) for value in values)


def _is_needed(name: str, of: PythonClass, view: FileView) -> bool:
    """Return whether the class calls what needs an attribute; most is needed by the node itself."""
    methods = _USED_LATER.get(name)
    text = view.text(of.node)
    return methods is None or any(f"self.{one}(" in text for one in methods)


def _place(values: list[Node]) -> Node | None:
    """Return the assignment in a method whose value stands first."""
    for value in values:
        assigned = value.parent
        left = assigned.child_by_field_name("left") if assigned is not None else None
        if assigned is not None and assigned.type == "assignment" and left is not None and left.type == "attribute":
            return assigned
    return None


RULE = FileRule(
    id="node.reserved_attribute_python",
    title="Attribute with the name of one of the node (rclpy)",
    finds="An assignment to `self.clients`, `self.timers`, `self.publishers`, `self.context` and the other properties "
    "of `rclpy.node.Node` that cannot be set, or to an attribute in which it keeps what it needs (`self._parameters`, "
    "`self._clock` …), in a class derived from it alone. Choose another name.",
    why="A property without a setter raises AttributeError, so that the node ends at start. An attribute that is "
    "overwritten takes its publishers, parameters or clock away from the node: nothing says so until they are used.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("lifetime",),
    bad="""import rclpy
from rclpy.node import Node
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.clients = {}
""",
    good="""import rclpy
from rclpy.node import Node
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.grippers = {}
""",
    syntax="python",
    whole=True,
    words=("Node",),
    mentions=RCLPY,
    found=found,
)
