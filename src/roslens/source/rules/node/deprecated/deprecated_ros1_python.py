"""Rule ``node.deprecated_ros1_python``: names of ROS 1 in Python that do nothing any more."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.deprecated.table import PYTHON_ROS1, find
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a name of the table that is called with a literal."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if given and given[0].type == "string" and not _falls_back(node):
        yield from find(node, view, "node.deprecated_ros1_python", _ROWS)


def _falls_back(node: Node) -> bool:
    """Tell whether a node is what is done where an import failed: it is for old distributions."""
    return above(node, "except_clause") is not None


_ROWS = PYTHON_ROS1

RULE = FileRule(
    id="node.deprecated_ros1_python",
    title="Deprecated name of ROS 1 (Python)",
    finds="A name that a distribution deprecated or removed. The finding says since when, and what to write.",
    why="What is deprecated warns in every build of everybody who uses it, and with the next distribution it does not "
    "build.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("deprecated",),
    bad="import roslib\nroslib.load_manifest('arm')\n",
    good="import rospy\n",
    syntax="python",
    anchors=tuple(row.name for row in PYTHON_ROS1),
    mentions=("roslib",),
    found=found,
)
