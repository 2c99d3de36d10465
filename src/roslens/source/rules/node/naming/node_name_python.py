"""Rule ``node.node_name_python``: a name of a node that ROS refuses, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.naming.names import node_fault
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_NODE = re.compile(r"(?<![\w.])(?:rclpy\.(?:node|lifecycle)\.)?(?:Lifecycle)?Node\b")
_IMPORTED = re.compile(
    rb"from\s+rclpy(?:\.\w+)*\s+import\s+(?:\([^)]*|[^\n]*)\bNode\b|from\s+rclpy(?:\.\w+)*\s+import\s+\*|LifecycleNode"
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a literal name handed to a node's ``__init__``, ``create_node`` or ``init_node``."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or not given or given[0].type != "string" or view.text(given[0])[:1] not in "'\"":
        return
    if view.text(node) == "__init__":
        of_class = above(call, "class_definition")
        bases = view.text(of_class.child_by_field_name("superclasses")) if of_class is not None else ""
        if not _is_of_rclpy(bases, view) or "super" not in view.text(call):
            return
    fault = node_fault(view.text(given[0])[1:-1])
    if fault:
        yield view.hit(
            "node.node_name_python",
            given[0],
            f"name of a node `{view.text(given[0])}` {fault}, which ROS refuses with an exception; expected letters, "
            "digits "
            "and _",
        )


def _is_of_rclpy(bases: str, view: FileView) -> bool:
    """Return whether a class is a node of rclpy: trees of behaviours and parsers have classes of that name as well."""
    named = _NODE.search(bases)
    return named is not None and ("rclpy." in named[0] or _IMPORTED.search(view.code) is not None)


RULE = FileRule(
    id="node.node_name_python",
    title="Name of a node that ROS refuses (Python)",
    finds="A literal name of a node with a dash, a slash, a space or a digit at its beginning. Rename it.",
    why="rclpy raises InvalidNodeNameException, rospy ValueError for a slash: the program ends at its start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("names",),
    bad="import rclpy\nnode = rclpy.create_node('arm-node')\n",
    good="import rclpy\nnode = rclpy.create_node('arm_node')\n",
    syntax="python",
    anchors=("__init__", "create_node"),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
