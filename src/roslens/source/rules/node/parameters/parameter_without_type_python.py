"""Rule ``node.parameter_without_type_python``: a parameter that is declared with its name alone, in rclpy."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a declaration with a name and nothing else."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is not None and len(given) == 1 and given[0].type == "string" and not keywords(call, view):
        yield view.hit(
            "node.parameter_without_type_python",
            call,
            f"`{view.text(call)}` names neither a value nor a type, which rclpy warns of since Galactic; expected a "
            "default, or `Parameter.Type.…`",
        )


RULE = FileRule(
    id="node.parameter_without_type_python",
    title="Parameter declared without a type (rclpy)",
    finds="`declare_parameter(name)` without a default value or a type. Give a default, or `Parameter.Type.DOUBLE`.",
    why="Parameters have one type for good since ROS 2 Galactic, and from there on a declaration by name alone is "
    "deprecated: rclpy warns of it at each start. Foxy says nothing. In both its value is None where nobody sets one, "
    "and the first look at it fails far from here.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("parameters", "deprecated"),
    bad="import rclpy\nself.declare_parameter('limit')\n",
    good="import rclpy\nself.declare_parameter('limit', 0.5)\n",
    syntax="python",
    anchors=("declare_parameter",),
    mentions=RCLPY,
    found=found,
)
